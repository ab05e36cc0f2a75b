/* SR400, 6R arm with a parallelogram
 *
 * Functions of sr400_tile.h.
 * This file includes itself once for every instruction set.
 * Temporaries are named as in sr400_base_regressor.c.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#ifndef MODELER_VERSION

#include "sr400_tile.h"

/* Geometry; see sr400.c. */
#ifndef SR400_GEO_g
#define SR400_GEO_g 9.81
#endif
#ifndef SR400_GEO_D2
#define SR400_GEO_D2 0.3
#endif
#ifndef SR400_GEO_D3
#define SR400_GEO_D3 0.75
#endif
#ifndef SR400_GEO_D4
#define SR400_GEO_D4 0.15
#endif
#ifndef SR400_GEO_RL4
#define SR400_GEO_RL4 0.8
#endif
#ifndef SR400_GEO_D8
#define SR400_GEO_D8 0.35
#endif

static const double sr400_geo_g = SR400_GEO_g;
static const double sr400_geo_D2 = SR400_GEO_D2;
static const double sr400_geo_D3 = SR400_GEO_D3;
static const double sr400_geo_D4 = SR400_GEO_D4;
static const double sr400_geo_RL4 = SR400_GEO_RL4;
static const double sr400_geo_D8 = SR400_GEO_D8;

#define MODELER_BODY "sr400_tile.c"
#include "modeler_versions.h"

static const int row[] = {
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2,
    2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 4, 4, 4, 4, 4, 4, 4, 5,
    5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5
};

static const int column[] = {
    0, 1, 2, 3, 4, 6, 7, 8, 9, 10, 11, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27,
    28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 1, 2, 3, 4, 5, 6, 7, 13, 14, 20, 21, 27, 28, 34, 35,
    38, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 22, 23,
    24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 29, 30, 31, 32, 33, 34, 35, 8, 9, 10, 11, 12,
    13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36,
    37, 38
};

#define TILED(version) \
    {6, 39, 0, 126, row, column, tile_##version, NULL, 0, NULL}

static const modeler_tiled tiled[] = {MODELER_EACH_VERSION(TILED)};

const modeler_tiled *sr400_tiled(void)
{
    return &tiled[MODELER_BEST_VERSION];
}

const char *sr400_tile_signature(void)
{
    return "2e6957814012ed07";
}

#else /* for one instruction set */

#include "modeler_lanes.h"

/* MODELER_WIDTH samples.
 * 291 additions, 398 multiplications for each. */
MODELER_INLINE void MODELER_VERSION(entries)(const double *q, const double *qd, const double *qdd,
                                             const double *s, double *values)
{
    (void)s;

    const modeler_lanes q_1 = MODELER_ROWS(q, 6, 1);
    const modeler_lanes q_2 = MODELER_ROWS(q, 6, 2);
    const modeler_lanes q_3 = MODELER_ROWS(q, 6, 3);
    const modeler_lanes q_4 = MODELER_ROWS(q, 6, 4);
    const modeler_lanes q_5 = MODELER_ROWS(q, 6, 5);
    const modeler_lanes qd_0 = MODELER_ROWS(qd, 6, 0);
    const modeler_lanes qd_1 = MODELER_ROWS(qd, 6, 1);
    const modeler_lanes qd_2 = MODELER_ROWS(qd, 6, 2);
    const modeler_lanes qd_3 = MODELER_ROWS(qd, 6, 3);
    const modeler_lanes qd_4 = MODELER_ROWS(qd, 6, 4);
    const modeler_lanes qd_5 = MODELER_ROWS(qd, 6, 5);
    const modeler_lanes qdd_0 = MODELER_ROWS(qdd, 6, 0);
    const modeler_lanes qdd_1 = MODELER_ROWS(qdd, 6, 1);
    const modeler_lanes qdd_2 = MODELER_ROWS(qdd, 6, 2);
    const modeler_lanes qdd_3 = MODELER_ROWS(qdd, 6, 3);
    const modeler_lanes qdd_4 = MODELER_ROWS(qdd, 6, 4);
    const modeler_lanes qdd_5 = MODELER_ROWS(qdd, 6, 5);

    modeler_lanes s1, c1;
    modeler_lanes_sincos(q_1, &s1, &c1);
    const modeler_lanes t1 = q_1 - q_5;
    modeler_lanes sa2, ca2;
    modeler_lanes_sincos(t1, &sa2, &ca2);
    modeler_lanes s2, c2;
    modeler_lanes_sincos(q_2, &s2, &c2);
    modeler_lanes s3, c3;
    modeler_lanes_sincos(q_3, &s3, &c3);
    modeler_lanes s4, c4;
    modeler_lanes_sincos(q_4, &s4, &c4);
    modeler_lanes s5, c5;
    modeler_lanes_sincos(q_5, &s5, &c5);

    MODELER_PUT(0) = qdd_0;
    /* link 2: angular velocity, w2 = R2' w1 + qd2 z */
    const modeler_lanes minus_w2_x = s1*qd_0;
    const modeler_lanes minus_w2_y = c1*qd_0;
    const modeler_lanes ww2_xy = minus_w2_x*minus_w2_y;
    MODELER_PUT(37) = -ww2_xy;
    /* link 2: acceleration of points of the link, U2 = [wd2 x] + [w2 x][w2 x] */
    const modeler_lanes U2_yz = s1*qdd_0;
    const modeler_lanes minus_ww2_yz = qd_1*minus_w2_y;
    /* link 2: angular acceleration, wd2 = R2' wd1 + (R2' w1) x qd2 z + qdd2 z */
    const modeler_lanes minus_wd2_x = U2_yz + minus_ww2_yz;
    const modeler_lanes minus_ww2_xz = qd_1*minus_w2_x;
    MODELER_PUT(1) = s1*minus_wd2_x + c1*minus_ww2_xz;
    const modeler_lanes ww2_zz = qd_1*qd_1;
    const modeler_lanes minus_U2_xx = minus_w2_y*minus_w2_y + ww2_zz;
    const modeler_lanes minus_U2_yy = minus_w2_x*minus_w2_x + ww2_zz;
    MODELER_PUT(38) = minus_U2_yy - minus_U2_xx;
    const modeler_lanes minus_U2_xz = c1*qdd_0;
    const modeler_lanes minus_wd2_y = minus_U2_xz - minus_ww2_xz;
    const modeler_lanes minus_U2_zx = minus_ww2_xz - minus_wd2_y;
    const modeler_lanes minus_U2_zy = minus_ww2_yz + minus_wd2_x;
    MODELER_PUT(2) = c1*minus_U2_zy - s1*minus_U2_zx;
    MODELER_PUT(39) = -U2_yz;
    const modeler_lanes U2_yx = qdd_1 + ww2_xy;
    const modeler_lanes ww1_zz = qd_0*qd_0;
    MODELER_PUT(3) = c1*(ww1_zz - minus_U2_xx) - s1*U2_yx;
    MODELER_PUT(40) = -minus_U2_xz;
    const modeler_lanes minus_U2_xy = qdd_1 - ww2_xy;
    MODELER_PUT(4) = -(s1*(ww1_zz - minus_U2_yy) + c1*minus_U2_xy);
    MODELER_PUT(41) = qdd_1;
    /* link 2: acceleration of the origin less gravity, vd2 = R2' (vd1 + U1 p2) */
    const modeler_lanes minus_vd2a_x = sr400_geo_D2*ww1_zz;
    const modeler_lanes minus_vd2_y = sr400_geo_g*c1 - s1*minus_vd2a_x;
    MODELER_PUT(42) = -minus_vd2_y;
    const modeler_lanes vd2_z = sr400_geo_D2*qdd_0;
    MODELER_PUT(5) = c1*vd2_z - sr400_geo_D2*minus_U2_zx;
    const modeler_lanes minus_vd2_x = c1*minus_vd2a_x + sr400_geo_g*s1;
    MODELER_PUT(43) = minus_vd2_x;
    MODELER_PUT(6) = -(s1*vd2_z + sr400_geo_D2*minus_U2_zy);
    /* link 3: angular velocity, w3 = R3' w2 + qd3 z */
    const modeler_lanes minus_w3_x = sa2*minus_w2_x + ca2*minus_w2_y;
    const modeler_lanes minus_w3_y = sa2*minus_w2_y - ca2*minus_w2_x;
    const modeler_lanes ww3_xy = minus_w3_x*minus_w3_y;
    MODELER_PUT(95) = -ww3_xy;
    const modeler_lanes t26 = qd_1 - qd_5;
    /* link 3: angular acceleration, wd3 = R3' wd2 + (R3' w2) x qd3 z + qdd3 z */
    const modeler_lanes minus_wd3_x = sa2*minus_wd2_x + ca2*minus_wd2_y - t26*minus_w3_y;
    const modeler_lanes minus_ww3_xz = qd_5*minus_w3_x;
    MODELER_PUT(7) = c5*minus_wd3_x - s5*minus_ww3_xz;
    const modeler_lanes ww3_zz = qd_5*qd_5;
    /* link 3: acceleration of points of the link, U3 = [wd3 x] + [w3 x][w3 x] */
    const modeler_lanes minus_U3_xx = minus_w3_y*minus_w3_y + ww3_zz;
    const modeler_lanes minus_U3_yy = minus_w3_x*minus_w3_x + ww3_zz;
    MODELER_PUT(96) = minus_U3_yy - minus_U3_xx;
    const modeler_lanes minus_wd3_y = sa2*minus_wd2_y - ca2*minus_wd2_x + t26*minus_w3_x;
    const modeler_lanes U3_zx = minus_wd3_y - minus_ww3_xz;
    const modeler_lanes minus_ww3_yz = qd_5*minus_w3_y;
    const modeler_lanes minus_U3_zy = minus_wd3_x + minus_ww3_yz;
    MODELER_PUT(8) = c5*U3_zx - s5*minus_U3_zy;
    MODELER_PUT(97) = minus_ww3_yz - minus_wd3_x;
    const modeler_lanes U3_yx = qdd_5 + ww3_xy;
    MODELER_PUT(9) = -(c5*U3_yx + s5*(ww1_zz - minus_U3_xx));
    MODELER_PUT(98) = -(minus_wd3_y + minus_ww3_xz);
    const modeler_lanes minus_U3_xy = qdd_5 - ww3_xy;
    MODELER_PUT(10) = s5*minus_U3_xy - c5*(ww1_zz - minus_U3_yy);
    MODELER_PUT(99) = qdd_5;
    /* link 3: acceleration of the origin less gravity, vd3 = R3' (vd2 + U2 p3) */
    const modeler_lanes minus_vd3a_y = minus_vd2_y - sr400_geo_D3*U2_yx;
    const modeler_lanes minus_vd3a_x = minus_vd2_x + sr400_geo_D3*minus_U2_xx;
    const modeler_lanes minus_vd3_y = sa2*minus_vd3a_y - ca2*minus_vd3a_x;
    MODELER_PUT(100) = -minus_vd3_y;
    /* link 3: velocity of the origin, for unit speed of each joint below, m3 = R3' (m2 + e2 x p3)
        */
    const modeler_lanes m3_2x = sr400_geo_D3*ca2;
    const modeler_lanes m3_2y = sr400_geo_D3*sa2;
    MODELER_PUT(44) = U3_yx*m3_2y - minus_U3_xx*m3_2x;
    const modeler_lanes vd3_z = vd2_z - sr400_geo_D3*minus_U2_zx;
    const modeler_lanes m3_1z = sr400_geo_D2 + sr400_geo_D3*c1;
    MODELER_PUT(11) = m3_1z*U3_zx - s5*vd3_z;
    const modeler_lanes minus_vd3_x = sa2*minus_vd3a_x + ca2*minus_vd3a_y;
    MODELER_PUT(101) = minus_vd3_x;
    MODELER_PUT(45) = -(minus_U3_xy*m3_2x + minus_U3_yy*m3_2y);
    MODELER_PUT(12) = -(c5*vd3_z + m3_1z*minus_U3_zy);
    /* link 4: angular velocity, w4 = R4' w3 + qd4 z */
    const modeler_lanes minus_w4_y = c2*qd_5 - s2*minus_w3_x;
    /* link 4: angular acceleration, wd4 = R4' wd3 + (R4' w3) x qd4 z + qdd4 z */
    const modeler_lanes minus_wd4_x = c2*minus_wd3_x + s2*qdd_5 + qd_2*minus_w4_y;
    const modeler_lanes minus_w4_x = c2*minus_w3_x + s2*qd_5;
    const modeler_lanes w4_z = qd_2 - minus_w3_y;
    const modeler_lanes minus_ww4_xz = minus_w4_x*w4_z;
    const modeler_lanes t51 = c2*minus_ww4_xz;
    MODELER_PUT(102) = s2*minus_wd4_x + t51;
    const modeler_lanes ww4_xy = minus_w4_x*minus_w4_y;
    MODELER_PUT(53) = -ww4_xy;
    /* link 4: axes of the joints below, for unit speed of each, e4 = R4' e3 */
    const modeler_lanes minus_e4_1x = c2*c5;
    const modeler_lanes e4_1y = s2*c5;
    const modeler_lanes t55 = minus_ww4_xz*e4_1y;
    MODELER_PUT(13) = minus_wd4_x*minus_e4_1x - t55 - s5*ww4_xy;
    const modeler_lanes minus_wd4_y = c2*qdd_5 - s2*minus_wd3_x - qd_2*minus_w4_x;
    /* link 4: acceleration of points of the link, U4 = [wd4 x] + [w4 x][w4 x] */
    const modeler_lanes U4_zx = minus_wd4_y - minus_ww4_xz;
    const modeler_lanes minus_ww4_yz = minus_w4_y*w4_z;
    const modeler_lanes minus_U4_zy = minus_wd4_x + minus_ww4_yz;
    MODELER_PUT(103) = s2*U4_zx + c2*minus_U4_zy;
    const modeler_lanes ww4_zz = w4_z*w4_z;
    const modeler_lanes minus_U4_xx = minus_w4_y*minus_w4_y + ww4_zz;
    const modeler_lanes minus_U4_yy = minus_w4_x*minus_w4_x + ww4_zz;
    /* link 4: moment on the link at its origin for one unit of a parameter, n4 = J4 wd4 + w4 x J4
        w4 + MS4 x vd4 */
    const modeler_lanes minus_n4_XYz = minus_U4_xx - minus_U4_yy;
    MODELER_PUT(54) = -minus_n4_XYz;
    MODELER_PUT(14) = U4_zx*minus_e4_1x - minus_U4_zy*e4_1y - s5*minus_n4_XYz;
    const modeler_lanes wd4_z = qdd_2 - minus_wd3_y;
    const modeler_lanes U4_yx = wd4_z + ww4_xy;
    const modeler_lanes minus_n4_XZy = minus_U3_yy - minus_U4_xx;
    MODELER_PUT(104) = c2*minus_n4_XZy - s2*U4_yx;
    const modeler_lanes U4_yz = minus_wd4_x - minus_ww4_yz;
    MODELER_PUT(55) = -U4_yz;
    MODELER_PUT(15) = -(U4_yx*minus_e4_1x + e4_1y*minus_n4_XZy + s5*U4_yz);
    const modeler_lanes n4_YZx = minus_U3_yy - minus_U4_yy;
    const modeler_lanes minus_U4_xy = wd4_z - ww4_xy;
    MODELER_PUT(105) = -(s2*n4_YZx + c2*minus_U4_xy);
    const modeler_lanes minus_U4_xz = minus_wd4_y + minus_ww4_xz;
    MODELER_PUT(56) = -minus_U4_xz;
    MODELER_PUT(16) = -(minus_e4_1x*n4_YZx - minus_U4_xy*e4_1y + s5*minus_U4_xz);
    MODELER_PUT(106) = s2*minus_ww4_yz - t51;
    MODELER_PUT(57) = wd4_z;
    MODELER_PUT(17) = t55 + minus_ww4_yz*minus_e4_1x + s5*wd4_z;
    /* link 4: acceleration of the origin less gravity, vd4 = R4' (vd3 + U3 p4) */
    const modeler_lanes minus_vd4_z = sr400_geo_RL4*minus_U3_yy - sr400_geo_D4*U3_yx + minus_vd3_y;
    /* link 4: velocity of the origin, for unit speed of each joint below, m4 = R4' (m3 + e3 x p4)
        */
    const modeler_lanes minus_m4_3x = sr400_geo_RL4*c2;
    const modeler_lanes m4_3y = sr400_geo_RL4*s2;
    MODELER_PUT(107) = minus_U4_xx*minus_m4_3x + U4_yx*m4_3y + sr400_geo_D4*U4_zx - c2*minus_vd4_z;
    const modeler_lanes vd4a_z = sr400_geo_D4*U3_zx - sr400_geo_RL4*minus_U3_zy + vd3_z;
    const modeler_lanes minus_vd4a_x = sr400_geo_D4*minus_U3_xx + sr400_geo_RL4*minus_U3_xy +
        minus_vd3_x;
    const modeler_lanes minus_vd4_y = c2*vd4a_z - s2*minus_vd4a_x;
    MODELER_PUT(58) = -minus_vd4_y;
    const modeler_lanes t77 = sr400_geo_RL4 - m3_2x;
    const modeler_lanes minus_m4_2x = c2*t77;
    const modeler_lanes t79 = minus_m4_2x - minus_m4_3x;
    const modeler_lanes m4_2y = s2*t77;
    const modeler_lanes t81 = m4_2y - m4_3y;
    MODELER_PUT(46) = minus_U4_xx*t79 + U4_yx*t81 + U4_zx*m3_2y;
    const modeler_lanes t82 = m3_1z - (sr400_geo_RL4*c5 + sr400_geo_D4*s5);
    const modeler_lanes minus_m4_1x = s2*t82;
    const modeler_lanes minus_m4_1y = c2*t82;
    MODELER_PUT(18) = minus_vd4_z*e4_1y - s5*minus_vd4_y + (minus_U4_xx*minus_m4_1x -
        U4_yx*minus_m4_1y);
    MODELER_PUT(108) = minus_U4_xy*minus_m4_3x - minus_U4_yy*m4_3y - sr400_geo_D4*minus_U4_zy +
        s2*minus_vd4_z;
    const modeler_lanes minus_vd4_x = c2*minus_vd4a_x + s2*vd4a_z;
    MODELER_PUT(59) = minus_vd4_x;
    MODELER_PUT(47) = minus_U4_xy*t79 - minus_U4_yy*t81 - minus_U4_zy*m3_2y;
    MODELER_PUT(19) = minus_vd4_z*minus_e4_1x + s5*minus_vd4_x + (minus_U4_xy*minus_m4_1x +
        minus_U4_yy*minus_m4_1y);
    /* link 5: angular velocity, w5 = R5' w4 + qd5 z */
    const modeler_lanes w5_y = c3*w4_z + s3*minus_w4_x;
    /* link 5: angular acceleration, wd5 = R5' wd4 + (R5' w4) x qd5 z + qdd5 z */
    const modeler_lanes minus_wd5_x = c3*minus_wd4_x - s3*wd4_z - qd_3*w5_y;
    /* link 5: axes of the joints below, for unit speed of each, e5 = R5' e4 */
    const modeler_lanes minus_e5_2x = s2*c3;
    const modeler_lanes minus_w5_x = c3*minus_w4_x - s3*w4_z;
    const modeler_lanes w5_z = qd_3 + minus_w4_y;
    const modeler_lanes minus_ww5_xz = minus_w5_x*w5_z;
    const modeler_lanes e5_2y = s2*s3;
    const modeler_lanes t93 = minus_ww5_xz*e5_2y;
    const modeler_lanes minus_ww5_xy = minus_w5_x*w5_y;
    MODELER_PUT(109) = minus_wd5_x*minus_e5_2x - t93 + c2*minus_ww5_xy;
    MODELER_PUT(74) = minus_ww5_xy;
    const modeler_lanes t95 = c3*minus_ww5_xz;
    MODELER_PUT(60) = -(s3*minus_wd5_x + t95);
    const modeler_lanes minus_e5_1x = c3*minus_e4_1x - s3*s5;
    const modeler_lanes e5_1y = c3*s5 + s3*minus_e4_1x;
    const modeler_lanes t98 = minus_ww5_xz*e5_1y;
    MODELER_PUT(20) = minus_wd5_x*minus_e5_1x - t98 - minus_ww5_xy*e4_1y;
    const modeler_lanes wd5_y = c3*wd4_z + s3*minus_wd4_x + qd_3*minus_w5_x;
    /* link 5: acceleration of points of the link, U5 = [wd5 x] + [w5 x][w5 x] */
    const modeler_lanes minus_U5_zx = wd5_y + minus_ww5_xz;
    const modeler_lanes ww5_yz = w5_y*w5_z;
    const modeler_lanes minus_U5_zy = minus_wd5_x - ww5_yz;
    const modeler_lanes ww5_zz = w5_z*w5_z;
    const modeler_lanes minus_U5_xx = w5_y*w5_y + ww5_zz;
    const modeler_lanes minus_U5_yy = minus_w5_x*minus_w5_x + ww5_zz;
    /* link 5: moment on the link at its origin for one unit of a parameter, n5 = J5 wd5 + w5 x J5
        w5 + MS5 x vd5 */
    const modeler_lanes minus_n5_XYz = minus_U5_xx - minus_U5_yy;
    MODELER_PUT(110) = -(minus_U5_zx*minus_e5_2x + minus_U5_zy*e5_2y + c2*minus_n5_XYz);
    MODELER_PUT(75) = -minus_n5_XYz;
    MODELER_PUT(61) = s3*minus_U5_zx - c3*minus_U5_zy;
    MODELER_PUT(21) = e4_1y*minus_n5_XYz - (minus_U5_zx*minus_e5_1x + minus_U5_zy*e5_1y);
    const modeler_lanes wd5_z = qdd_3 + minus_wd4_y;
    const modeler_lanes U5_yx = wd5_z - minus_ww5_xy;
    const modeler_lanes minus_n5_XZy = minus_U4_yy - minus_U5_xx;
    const modeler_lanes U5_yz = minus_wd5_x + ww5_yz;
    MODELER_PUT(111) = -(U5_yx*minus_e5_2x + e5_2y*minus_n5_XZy + c2*U5_yz);
    MODELER_PUT(76) = -U5_yz;
    MODELER_PUT(62) = s3*U5_yx - c3*minus_n5_XZy;
    MODELER_PUT(22) = U5_yz*e4_1y - (U5_yx*minus_e5_1x + e5_1y*minus_n5_XZy);
    const modeler_lanes n5_YZx = minus_U4_yy - minus_U5_yy;
    const modeler_lanes minus_U5_xy = wd5_z + minus_ww5_xy;
    const modeler_lanes U5_xz = wd5_y - minus_ww5_xz;
    MODELER_PUT(112) = c2*U5_xz - (minus_e5_2x*n5_YZx - minus_U5_xy*e5_2y);
    MODELER_PUT(77) = U5_xz;
    MODELER_PUT(63) = s3*n5_YZx + c3*minus_U5_xy;
    MODELER_PUT(23) = -(minus_e5_1x*n5_YZx - minus_U5_xy*e5_1y + U5_xz*e4_1y);
    MODELER_PUT(113) = t93 - ww5_yz*minus_e5_2x + c2*wd5_z;
    MODELER_PUT(78) = wd5_z;
    MODELER_PUT(64) = t95 + s3*ww5_yz;
    MODELER_PUT(24) = t98 - ww5_yz*minus_e5_1x - wd5_z*e4_1y;
    /* link 5: acceleration of the origin less gravity, vd5 = R5' (vd4 + U4 p5) */
    const modeler_lanes minus_vd5_y = c3*minus_vd4_z - s3*minus_vd4_x;
    /* link 5: velocity of the origin, for unit speed of each joint below, m5 = R5' (m4 + e4 x p5)
        */
    const modeler_lanes minus_m5_3x = c3*minus_m4_3x - sr400_geo_D4*s3;
    const modeler_lanes m5_3y = sr400_geo_D4*c3 + s3*minus_m4_3x;
    MODELER_PUT(114) = minus_U5_xx*minus_m5_3x + U5_yx*m5_3y + minus_U5_zx*m4_3y -
        (minus_vd4_y*e5_2y + c2*minus_vd5_y);
    MODELER_PUT(79) = -minus_vd5_y;
    MODELER_PUT(65) = -c3*minus_vd4_y;
    const modeler_lanes m4_2z = sr400_geo_D4 + m3_2y;
    const modeler_lanes minus_m5_2x = c3*minus_m4_2x - s3*m4_2z;
    const modeler_lanes t119 = minus_m5_2x - minus_m5_3x;
    const modeler_lanes t120 = c3*m4_2z + s3*minus_m4_2x - m5_3y;
    MODELER_PUT(48) = minus_U5_xx*t119 + U5_yx*t120 + minus_U5_zx*t81;
    const modeler_lanes minus_m5_1x = c3*minus_m4_1x;
    const modeler_lanes m5_1y = s3*minus_m4_1x;
    MODELER_PUT(25) = minus_U5_xx*minus_m5_1x + U5_yx*m5_1y - minus_U5_zx*minus_m4_1y -
        (minus_vd4_y*e5_1y - minus_vd5_y*e4_1y);
    const modeler_lanes minus_vd5_x = c3*minus_vd4_x + s3*minus_vd4_z;
    MODELER_PUT(115) = minus_U5_xy*minus_m5_3x - minus_U5_yy*m5_3y + minus_U5_zy*m4_3y -
        (minus_vd4_y*minus_e5_2x - c2*minus_vd5_x);
    MODELER_PUT(80) = minus_vd5_x;
    MODELER_PUT(66) = s3*minus_vd4_y;
    MODELER_PUT(49) = minus_U5_xy*t119 - minus_U5_yy*t120 + minus_U5_zy*t81;
    MODELER_PUT(26) = minus_U5_xy*minus_m5_1x - minus_U5_yy*m5_1y - minus_U5_zy*minus_m4_1y -
        (minus_vd4_y*minus_e5_1x + minus_vd5_x*e4_1y);
    /* link 6: angular velocity, w6 = R6' w5 + qd6 z */
    const modeler_lanes minus_w6_y = c4*w5_z - s4*minus_w5_x;
    /* link 6: angular acceleration, wd6 = R6' wd5 + (R6' w5) x qd6 z + qdd6 z */
    const modeler_lanes minus_wd6_x = c4*minus_wd5_x + s4*wd5_z + qd_4*minus_w6_y;
    /* link 6: axes of the joints below, for unit speed of each, e6 = R6' e5 */
    const modeler_lanes minus_e6_2x = c4*minus_e5_2x + c2*s4;
    const modeler_lanes minus_w6_x = c4*minus_w5_x + s4*w5_z;
    const modeler_lanes w6_z = qd_4 + w5_y;
    const modeler_lanes minus_ww6_xz = minus_w6_x*w6_z;
    const modeler_lanes minus_e6_2y = c2*c4 - s4*minus_e5_2x;
    const modeler_lanes t131 = minus_ww6_xz*minus_e6_2y;
    const modeler_lanes ww6_xy = minus_w6_x*minus_w6_y;
    MODELER_PUT(116) = minus_wd6_x*minus_e6_2x + t131 - ww6_xy*e5_2y;
    MODELER_PUT(88) = -ww6_xy;
    const modeler_lanes t133 = c4*minus_ww6_xz;
    MODELER_PUT(81) = s4*minus_wd6_x + t133;
    const modeler_lanes e6_4x = s3*c4;
    const modeler_lanes minus_e6_4y = s3*s4;
    const modeler_lanes t136 = minus_ww6_xz*minus_e6_4y;
    MODELER_PUT(67) = -(minus_wd6_x*e6_4x - t136 + c3*ww6_xy);
    const modeler_lanes minus_e6_1x = c4*minus_e5_1x - s4*e4_1y;
    const modeler_lanes e6_1y = c4*e4_1y + s4*minus_e5_1x;
    const modeler_lanes t139 = minus_ww6_xz*e6_1y;
    MODELER_PUT(27) = minus_wd6_x*minus_e6_1x - t139 - ww6_xy*e5_1y;
    const modeler_lanes minus_wd6_y = c4*wd5_z - s4*minus_wd5_x - qd_4*minus_w6_x;
    /* link 6: acceleration of points of the link, U6 = [wd6 x] + [w6 x][w6 x] */
    const modeler_lanes U6_zx = minus_wd6_y - minus_ww6_xz;
    const modeler_lanes minus_ww6_yz = minus_w6_y*w6_z;
    const modeler_lanes minus_U6_zy = minus_wd6_x + minus_ww6_yz;
    const modeler_lanes ww6_zz = w6_z*w6_z;
    const modeler_lanes minus_U6_xx = minus_w6_y*minus_w6_y + ww6_zz;
    const modeler_lanes minus_U6_yy = minus_w6_x*minus_w6_x + ww6_zz;
    /* link 6: moment on the link at its origin for one unit of a parameter, n6 = J6 wd6 + w6 x J6
        w6 + MS6 x vd6 */
    const modeler_lanes minus_n6_XYz = minus_U6_xx - minus_U6_yy;
    MODELER_PUT(117) = U6_zx*minus_e6_2x + minus_U6_zy*minus_e6_2y - e5_2y*minus_n6_XYz;
    MODELER_PUT(89) = -minus_n6_XYz;
    MODELER_PUT(82) = s4*U6_zx + c4*minus_U6_zy;
    MODELER_PUT(68) = -(U6_zx*e6_4x - minus_U6_zy*minus_e6_4y + c3*minus_n6_XYz);
    MODELER_PUT(28) = U6_zx*minus_e6_1x - minus_U6_zy*e6_1y - e5_1y*minus_n6_XYz;
    const modeler_lanes wd6_z = qdd_4 + wd5_y;
    const modeler_lanes U6_yx = wd6_z + ww6_xy;
    const modeler_lanes minus_n6_XZy = minus_U5_yy - minus_U6_xx;
    const modeler_lanes U6_yz = minus_wd6_x - minus_ww6_yz;
    MODELER_PUT(118) = -(U6_yx*minus_e6_2x - minus_e6_2y*minus_n6_XZy + U6_yz*e5_2y);
    MODELER_PUT(90) = -U6_yz;
    MODELER_PUT(83) = c4*minus_n6_XZy - s4*U6_yx;
    MODELER_PUT(69) = U6_yx*e6_4x + minus_e6_4y*minus_n6_XZy - c3*U6_yz;
    MODELER_PUT(29) = -(U6_yx*minus_e6_1x + e6_1y*minus_n6_XZy + U6_yz*e5_1y);
    const modeler_lanes n6_YZx = minus_U5_yy - minus_U6_yy;
    const modeler_lanes minus_U6_xy = wd6_z - ww6_xy;
    const modeler_lanes minus_U6_xz = minus_wd6_y + minus_ww6_xz;
    MODELER_PUT(119) = -(minus_e6_2x*n6_YZx + minus_U6_xy*minus_e6_2y + minus_U6_xz*e5_2y);
    MODELER_PUT(91) = -minus_U6_xz;
    MODELER_PUT(84) = -(s4*n6_YZx + c4*minus_U6_xy);
    MODELER_PUT(70) = e6_4x*n6_YZx - minus_U6_xy*minus_e6_4y - c3*minus_U6_xz;
    MODELER_PUT(30) = -(minus_e6_1x*n6_YZx - minus_U6_xy*e6_1y + minus_U6_xz*e5_1y);
    MODELER_PUT(120) = wd6_z*e5_2y - (t131 - minus_ww6_yz*minus_e6_2x);
    MODELER_PUT(92) = wd6_z;
    MODELER_PUT(85) = s4*minus_ww6_yz - t133;
    MODELER_PUT(71) = c3*wd6_z - (t136 + minus_ww6_yz*e6_4x);
    MODELER_PUT(31) = t139 + minus_ww6_yz*minus_e6_1x + wd6_z*e5_1y;
    /* link 6: acceleration of the origin less gravity, vd6 = R6' (vd5 + U5 p6) */
    const modeler_lanes minus_vd6_y = c4*minus_vd4_y - s4*minus_vd5_x;
    /* link 6: velocity of the origin, for unit speed of each joint below, m6 = R6' (m5 + e5 x p6)
        */
    const modeler_lanes minus_m6_3x = c4*minus_m5_3x - s4*m4_3y;
    const modeler_lanes m6_3y = c4*m4_3y + s4*minus_m5_3x;
    MODELER_PUT(121) = minus_U6_xx*minus_m6_3x + U6_yx*m6_3y + U6_zx*m5_3y -
        (minus_vd5_y*minus_e6_2y + minus_vd6_y*e5_2y);
    MODELER_PUT(93) = -minus_vd6_y;
    MODELER_PUT(86) = -c4*minus_vd5_y;
    MODELER_PUT(72) = -(minus_vd5_y*minus_e6_4y + c3*minus_vd6_y);
    const modeler_lanes t158 = c4*minus_m5_2x - s4*m4_2y - minus_m6_3x;
    const modeler_lanes t159 = c4*m4_2y + s4*minus_m5_2x - m6_3y;
    MODELER_PUT(50) = minus_U6_xx*t158 + U6_yx*t159 + U6_zx*t120;
    const modeler_lanes minus_m6_1x = c4*minus_m5_1x + s4*minus_m4_1y;
    const modeler_lanes minus_m6_1y = c4*minus_m4_1y - s4*minus_m5_1x;
    MODELER_PUT(32) = minus_vd5_y*e6_1y - minus_vd6_y*e5_1y + (minus_U6_xx*minus_m6_1x -
        U6_yx*minus_m6_1y + U6_zx*m5_1y);
    const modeler_lanes minus_vd6_x = c4*minus_vd5_x + s4*minus_vd4_y;
    MODELER_PUT(122) = minus_vd5_y*minus_e6_2x + minus_vd6_x*e5_2y + (minus_U6_xy*minus_m6_3x -
        minus_U6_yy*m6_3y - minus_U6_zy*m5_3y);
    MODELER_PUT(94) = minus_vd6_x;
    MODELER_PUT(87) = s4*minus_vd5_y;
    MODELER_PUT(73) = c3*minus_vd6_x - minus_vd5_y*e6_4x;
    MODELER_PUT(51) = minus_U6_xy*t158 - minus_U6_yy*t159 - minus_U6_zy*t120;
    MODELER_PUT(33) = minus_vd5_y*minus_e6_1x + minus_vd6_x*e5_1y + (minus_U6_xy*minus_m6_1x +
        minus_U6_yy*minus_m6_1y - minus_U6_zy*m5_1y);
    /* link 7: acceleration of the origin less gravity, vd7 = R7' (vd1 + U1 p7) */
    const modeler_lanes minus_vd7_y = sr400_geo_g*c5 - s5*minus_vd2a_x;
    MODELER_PUT(123) = -minus_vd7_y;
    MODELER_PUT(34) = c5*vd2_z + sr400_geo_D2*minus_U3_zy;
    const modeler_lanes minus_vd7_x = c5*minus_vd2a_x + sr400_geo_g*s5;
    MODELER_PUT(124) = minus_vd7_x;
    MODELER_PUT(35) = sr400_geo_D2*U3_zx - s5*vd2_z;
    MODELER_PUT(125) = -(sr400_geo_D8*sa2*minus_U2_xy + sr400_geo_D8*ca2*minus_U2_yy);
    MODELER_PUT(52) = ca2*(minus_vd7_x + sr400_geo_D8*minus_U3_yy) + sa2*(minus_vd7_y -
        sr400_geo_D8*minus_U3_xy);
    MODELER_PUT(36) = -(s1*(vd2_z + sr400_geo_D8*minus_U3_zy) + (sr400_geo_D2 +
        sr400_geo_D8*c5)*minus_U2_zy);
}

MODELER_TARGET static void MODELER_VERSION(tile)(const double *q, const double *qd,
                                                 const double *qdd, const double *s, double *values)
{
    for (int lane = 0; lane < MODELER_LANES; lane += MODELER_WIDTH) {
        MODELER_VERSION(entries)(q, qd, qdd, s, values + lane);
        q += 6*MODELER_WIDTH;
        qd += 6*MODELER_WIDTH;
        qdd += 6*MODELER_WIDTH;
    }
}

#endif
