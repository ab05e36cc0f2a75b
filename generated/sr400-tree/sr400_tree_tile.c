/* SR400, 6R arm with a parallelogram, cut open
 *
 * Functions of sr400_tree_tile.h.
 * This file includes itself once for every instruction set.
 * Temporaries are named as in sr400_tree_base_regressor.c.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#ifndef MODELER_VERSION

#include "sr400_tree_tile.h"

/* Geometry; see sr400_tree.c. */
#ifndef SR400_TREE_GEO_g
#define SR400_TREE_GEO_g 9.81
#endif
#ifndef SR400_TREE_GEO_D2
#define SR400_TREE_GEO_D2 0.3
#endif
#ifndef SR400_TREE_GEO_D3
#define SR400_TREE_GEO_D3 0.75
#endif
#ifndef SR400_TREE_GEO_D4
#define SR400_TREE_GEO_D4 0.15
#endif
#ifndef SR400_TREE_GEO_RL4
#define SR400_TREE_GEO_RL4 0.8
#endif
#ifndef SR400_TREE_GEO_D8
#define SR400_TREE_GEO_D8 0.35
#endif

static const double sr400_tree_geo_g = SR400_TREE_GEO_g;
static const double sr400_tree_geo_D2 = SR400_TREE_GEO_D2;
static const double sr400_tree_geo_D3 = SR400_TREE_GEO_D3;
static const double sr400_tree_geo_D4 = SR400_TREE_GEO_D4;
static const double sr400_tree_geo_RL4 = SR400_TREE_GEO_RL4;
static const double sr400_tree_geo_D8 = SR400_TREE_GEO_D8;

#define MODELER_BODY "sr400_tree_tile.c"
#include "modeler_versions.h"

static const int row[] = {
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1,
    1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2,
    2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3,
    3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5, 5, 5, 5, 5, 5, 6, 6, 6, 6, 6, 6, 6, 6, 6,
    6, 6, 6, 6, 6, 7, 7, 7, 7, 7, 7, 7
};

static const int column[] = {
    0, 1, 2, 3, 4, 6, 7, 8, 9, 10, 11, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27,
    28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 41, 42, 43, 44, 45, 46, 48, 49, 1, 2, 3, 4, 5,
    6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30,
    31, 32, 33, 34, 35, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26,
    27, 28, 29, 30, 31, 32, 33, 34, 35, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29,
    30, 31, 32, 33, 34, 35, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 29, 30, 31, 32,
    33, 34, 35, 36, 37, 38, 39, 40, 41, 42, 43, 44, 45, 46, 47, 48, 49, 43, 44, 45, 46, 47, 48, 49
};

#define TILED(version) \
    {8, 50, 0, 172, row, column, tile_##version, NULL, 0, NULL}

static const modeler_tiled tiled[] = {MODELER_EACH_VERSION(TILED)};

const modeler_tiled *sr400_tree_tiled(void)
{
    return &tiled[MODELER_BEST_VERSION];
}

const char *sr400_tree_tile_signature(void)
{
    return "1fb9681687ac8601";
}

#else /* for one instruction set */

#include "modeler_lanes.h"

/* MODELER_WIDTH samples.
 * 340 additions, 454 multiplications for each. */
MODELER_INLINE void MODELER_VERSION(entries)(const double *q, const double *qd, const double *qdd,
                                             const double *s, double *values)
{
    (void)s;

    const modeler_lanes q_1 = MODELER_ROWS(q, 8, 1);
    const modeler_lanes q_2 = MODELER_ROWS(q, 8, 2);
    const modeler_lanes q_3 = MODELER_ROWS(q, 8, 3);
    const modeler_lanes q_4 = MODELER_ROWS(q, 8, 4);
    const modeler_lanes q_5 = MODELER_ROWS(q, 8, 5);
    const modeler_lanes q_6 = MODELER_ROWS(q, 8, 6);
    const modeler_lanes q_7 = MODELER_ROWS(q, 8, 7);
    const modeler_lanes qd_0 = MODELER_ROWS(qd, 8, 0);
    const modeler_lanes qd_1 = MODELER_ROWS(qd, 8, 1);
    const modeler_lanes qd_2 = MODELER_ROWS(qd, 8, 2);
    const modeler_lanes qd_3 = MODELER_ROWS(qd, 8, 3);
    const modeler_lanes qd_4 = MODELER_ROWS(qd, 8, 4);
    const modeler_lanes qd_5 = MODELER_ROWS(qd, 8, 5);
    const modeler_lanes qd_6 = MODELER_ROWS(qd, 8, 6);
    const modeler_lanes qd_7 = MODELER_ROWS(qd, 8, 7);
    const modeler_lanes qdd_0 = MODELER_ROWS(qdd, 8, 0);
    const modeler_lanes qdd_1 = MODELER_ROWS(qdd, 8, 1);
    const modeler_lanes qdd_2 = MODELER_ROWS(qdd, 8, 2);
    const modeler_lanes qdd_3 = MODELER_ROWS(qdd, 8, 3);
    const modeler_lanes qdd_4 = MODELER_ROWS(qdd, 8, 4);
    const modeler_lanes qdd_5 = MODELER_ROWS(qdd, 8, 5);
    const modeler_lanes qdd_6 = MODELER_ROWS(qdd, 8, 6);
    const modeler_lanes qdd_7 = MODELER_ROWS(qdd, 8, 7);

    modeler_lanes s1, c1;
    modeler_lanes_sincos(q_1, &s1, &c1);
    modeler_lanes s2, c2;
    modeler_lanes_sincos(q_2, &s2, &c2);
    modeler_lanes s3, c3;
    modeler_lanes_sincos(q_3, &s3, &c3);
    modeler_lanes s4, c4;
    modeler_lanes_sincos(q_4, &s4, &c4);
    modeler_lanes s5, c5;
    modeler_lanes_sincos(q_5, &s5, &c5);
    modeler_lanes s6, c6;
    modeler_lanes_sincos(q_6, &s6, &c6);
    modeler_lanes s7, c7;
    modeler_lanes_sincos(q_7, &s7, &c7);

    MODELER_PUT(0) = qdd_0;
    /* link 2: angular velocity, w2 = R2' w1 + qd2 z */
    const modeler_lanes minus_w2_x = s1*qd_0;
    const modeler_lanes minus_w2_y = c1*qd_0;
    const modeler_lanes ww2_xy = minus_w2_x*minus_w2_y;
    MODELER_PUT(46) = -ww2_xy;
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
    MODELER_PUT(47) = minus_U2_yy - minus_U2_xx;
    const modeler_lanes minus_U2_xz = c1*qdd_0;
    const modeler_lanes minus_wd2_y = minus_U2_xz - minus_ww2_xz;
    const modeler_lanes minus_U2_zx = minus_ww2_xz - minus_wd2_y;
    const modeler_lanes minus_U2_zy = minus_ww2_yz + minus_wd2_x;
    MODELER_PUT(2) = c1*minus_U2_zy - s1*minus_U2_zx;
    MODELER_PUT(48) = -U2_yz;
    const modeler_lanes U2_yx = qdd_1 + ww2_xy;
    const modeler_lanes ww1_zz = qd_0*qd_0;
    MODELER_PUT(3) = c1*(ww1_zz - minus_U2_xx) - s1*U2_yx;
    MODELER_PUT(49) = -minus_U2_xz;
    MODELER_PUT(4) = -(s1*(ww1_zz - minus_U2_yy) + c1*(qdd_1 - ww2_xy));
    MODELER_PUT(50) = qdd_1;
    /* link 2: acceleration of the origin less gravity, vd2 = R2' (vd1 + U1 p2) */
    const modeler_lanes minus_vd2a_x = sr400_tree_geo_D2*ww1_zz;
    const modeler_lanes minus_vd2_y = sr400_tree_geo_g*c1 - s1*minus_vd2a_x;
    MODELER_PUT(51) = -minus_vd2_y;
    const modeler_lanes vd2_z = sr400_tree_geo_D2*qdd_0;
    MODELER_PUT(5) = c1*vd2_z - sr400_tree_geo_D2*minus_U2_zx;
    const modeler_lanes minus_vd2_x = c1*minus_vd2a_x + sr400_tree_geo_g*s1;
    MODELER_PUT(52) = minus_vd2_x;
    MODELER_PUT(6) = -(s1*vd2_z + sr400_tree_geo_D2*minus_U2_zy);
    /* link 3: angular velocity, w3 = R3' w2 + qd3 z */
    const modeler_lanes minus_w3_x = c2*minus_w2_x + s2*minus_w2_y;
    const modeler_lanes minus_w3_y = c2*minus_w2_y - s2*minus_w2_x;
    const modeler_lanes ww3_xy = minus_w3_x*minus_w3_y;
    MODELER_PUT(81) = -ww3_xy;
    MODELER_PUT(53) = -ww3_xy;
    /* link 3: angular acceleration, wd3 = R3' wd2 + (R3' w2) x qd3 z + qdd3 z */
    const modeler_lanes minus_wd3_x = c2*minus_wd2_x + s2*minus_wd2_y + qd_2*minus_w3_y;
    /* link 3: axes of the joints below, for unit speed of each, e3 = R3' e2 */
    const modeler_lanes minus_e3_1x = s1*c2 + c1*s2;
    const modeler_lanes w3_z = qd_1 + qd_2;
    const modeler_lanes minus_ww3_xz = minus_w3_x*w3_z;
    const modeler_lanes minus_e3_1y = c1*c2 - s1*s2;
    MODELER_PUT(7) = minus_wd3_x*minus_e3_1x + minus_ww3_xz*minus_e3_1y;
    const modeler_lanes ww3_zz = w3_z*w3_z;
    /* link 3: acceleration of points of the link, U3 = [wd3 x] + [w3 x][w3 x] */
    const modeler_lanes minus_U3_xx = minus_w3_y*minus_w3_y + ww3_zz;
    const modeler_lanes minus_U3_yy = minus_w3_x*minus_w3_x + ww3_zz;
    /* link 3: moment on the link at its origin for one unit of a parameter, n3 = J3 wd3 + w3 x J3
        w3 + MS3 x vd3 */
    const modeler_lanes minus_n3_XYz = minus_U3_xx - minus_U3_yy;
    MODELER_PUT(82) = -minus_n3_XYz;
    MODELER_PUT(54) = -minus_n3_XYz;
    const modeler_lanes minus_wd3_y = c2*minus_wd2_y - s2*minus_wd2_x - qd_2*minus_w3_x;
    const modeler_lanes U3_zx = minus_wd3_y - minus_ww3_xz;
    const modeler_lanes minus_ww3_yz = minus_w3_y*w3_z;
    const modeler_lanes minus_U3_zy = minus_wd3_x + minus_ww3_yz;
    MODELER_PUT(8) = U3_zx*minus_e3_1x + minus_U3_zy*minus_e3_1y;
    const modeler_lanes U3_yz = minus_wd3_x - minus_ww3_yz;
    MODELER_PUT(83) = -U3_yz;
    MODELER_PUT(55) = -U3_yz;
    const modeler_lanes wd3_z = qdd_1 + qdd_2;
    const modeler_lanes U3_yx = wd3_z + ww3_xy;
    MODELER_PUT(9) = minus_e3_1y*(ww1_zz - minus_U3_xx) - U3_yx*minus_e3_1x;
    const modeler_lanes minus_U3_xz = minus_wd3_y + minus_ww3_xz;
    MODELER_PUT(84) = -minus_U3_xz;
    MODELER_PUT(56) = -minus_U3_xz;
    const modeler_lanes minus_U3_xy = wd3_z - ww3_xy;
    MODELER_PUT(10) = -(minus_e3_1x*(ww1_zz - minus_U3_yy) + minus_U3_xy*minus_e3_1y);
    MODELER_PUT(85) = wd3_z;
    MODELER_PUT(57) = wd3_z;
    /* link 3: acceleration of the origin less gravity, vd3 = R3' (vd2 + U2 p3) */
    const modeler_lanes minus_vd3a_y = minus_vd2_y - sr400_tree_geo_D3*U2_yx;
    const modeler_lanes minus_vd3a_x = minus_vd2_x + sr400_tree_geo_D3*minus_U2_xx;
    const modeler_lanes minus_vd3_y = c2*minus_vd3a_y - s2*minus_vd3a_x;
    MODELER_PUT(86) = -minus_vd3_y;
    /* link 3: velocity of the origin, for unit speed of each joint below, m3 = R3' (m2 + e2 x p3)
        */
    const modeler_lanes m3_2x = sr400_tree_geo_D3*s2;
    const modeler_lanes m3_2y = sr400_tree_geo_D3*c2;
    MODELER_PUT(58) = -(minus_U3_xx*m3_2x - U3_yx*m3_2y + minus_vd3_y);
    const modeler_lanes vd3_z = vd2_z - sr400_tree_geo_D3*minus_U2_zx;
    const modeler_lanes m3_1z = sr400_tree_geo_D2 + sr400_tree_geo_D3*c1;
    MODELER_PUT(11) = vd3_z*minus_e3_1y + U3_zx*m3_1z;
    const modeler_lanes minus_vd3_x = c2*minus_vd3a_x + s2*minus_vd3a_y;
    MODELER_PUT(87) = minus_vd3_x;
    MODELER_PUT(59) = minus_vd3_x - (minus_U3_xy*m3_2x + minus_U3_yy*m3_2y);
    MODELER_PUT(12) = -(vd3_z*minus_e3_1x + minus_U3_zy*m3_1z);
    /* link 4: angular velocity, w4 = R4' w3 + qd4 z */
    const modeler_lanes minus_w4_x = c3*minus_w3_x + s3*w3_z;
    const modeler_lanes minus_w4_y = c3*w3_z - s3*minus_w3_x;
    const modeler_lanes ww4_xy = minus_w4_x*minus_w4_y;
    MODELER_PUT(109) = -ww4_xy;
    /* link 4: angular acceleration, wd4 = R4' wd3 + (R4' w3) x qd4 z + qdd4 z */
    const modeler_lanes minus_wd4_x = c3*minus_wd3_x + s3*wd3_z + qd_3*minus_w4_y;
    const modeler_lanes w4_z = qd_3 - minus_w3_y;
    const modeler_lanes minus_ww4_xz = minus_w4_x*w4_z;
    const modeler_lanes t56 = c3*minus_ww4_xz;
    const modeler_lanes t57 = s3*minus_wd4_x + t56;
    MODELER_PUT(88) = t57;
    MODELER_PUT(60) = t57;
    /* link 4: axes of the joints below, for unit speed of each, e4 = R4' e3 */
    const modeler_lanes minus_e4_1x = c3*minus_e3_1x;
    const modeler_lanes e4_1y = s3*minus_e3_1x;
    const modeler_lanes t60 = minus_ww4_xz*e4_1y;
    MODELER_PUT(13) = minus_wd4_x*minus_e4_1x - t60 + ww4_xy*minus_e3_1y;
    const modeler_lanes ww4_zz = w4_z*w4_z;
    /* link 4: acceleration of points of the link, U4 = [wd4 x] + [w4 x][w4 x] */
    const modeler_lanes minus_U4_xx = minus_w4_y*minus_w4_y + ww4_zz;
    const modeler_lanes minus_U4_yy = minus_w4_x*minus_w4_x + ww4_zz;
    /* link 4: moment on the link at its origin for one unit of a parameter, n4 = J4 wd4 + w4 x J4
        w4 + MS4 x vd4 */
    const modeler_lanes minus_n4_XYz = minus_U4_xx - minus_U4_yy;
    MODELER_PUT(110) = -minus_n4_XYz;
    const modeler_lanes minus_wd4_y = c3*wd3_z - s3*minus_wd3_x - qd_3*minus_w4_x;
    const modeler_lanes U4_zx = minus_wd4_y - minus_ww4_xz;
    const modeler_lanes minus_ww4_yz = minus_w4_y*w4_z;
    const modeler_lanes minus_U4_zy = minus_wd4_x + minus_ww4_yz;
    const modeler_lanes t69 = s3*U4_zx + c3*minus_U4_zy;
    MODELER_PUT(89) = t69;
    MODELER_PUT(61) = t69;
    MODELER_PUT(14) = U4_zx*minus_e4_1x - minus_U4_zy*e4_1y + minus_e3_1y*minus_n4_XYz;
    const modeler_lanes U4_yz = minus_wd4_x - minus_ww4_yz;
    MODELER_PUT(111) = -U4_yz;
    const modeler_lanes wd4_z = qdd_3 - minus_wd3_y;
    const modeler_lanes U4_yx = wd4_z + ww4_xy;
    const modeler_lanes minus_n4_XZy = minus_U3_yy - minus_U4_xx;
    const modeler_lanes t74 = s3*U4_yx - c3*minus_n4_XZy;
    MODELER_PUT(90) = -t74;
    MODELER_PUT(62) = -t74;
    MODELER_PUT(15) = U4_yz*minus_e3_1y - (U4_yx*minus_e4_1x + e4_1y*minus_n4_XZy);
    const modeler_lanes minus_U4_xz = minus_wd4_y + minus_ww4_xz;
    MODELER_PUT(112) = -minus_U4_xz;
    const modeler_lanes n4_YZx = minus_U3_yy - minus_U4_yy;
    const modeler_lanes minus_U4_xy = wd4_z - ww4_xy;
    const modeler_lanes t78 = s3*n4_YZx + c3*minus_U4_xy;
    MODELER_PUT(91) = -t78;
    MODELER_PUT(63) = -t78;
    MODELER_PUT(16) = minus_U4_xz*minus_e3_1y - (minus_e4_1x*n4_YZx - minus_U4_xy*e4_1y);
    MODELER_PUT(113) = wd4_z;
    const modeler_lanes t79 = t56 - s3*minus_ww4_yz;
    MODELER_PUT(92) = -t79;
    MODELER_PUT(64) = -t79;
    MODELER_PUT(17) = t60 + minus_ww4_yz*minus_e4_1x - wd4_z*minus_e3_1y;
    /* link 4: acceleration of the origin less gravity, vd4 = R4' (vd3 + U3 p4) */
    const modeler_lanes vd4a_z = sr400_tree_geo_D4*U3_zx - sr400_tree_geo_RL4*minus_U3_zy + vd3_z;
    const modeler_lanes minus_vd4a_x = sr400_tree_geo_D4*minus_U3_xx +
        sr400_tree_geo_RL4*minus_U3_xy + minus_vd3_x;
    const modeler_lanes minus_vd4_y = c3*vd4a_z - s3*minus_vd4a_x;
    MODELER_PUT(114) = -minus_vd4_y;
    const modeler_lanes minus_vd4_z = sr400_tree_geo_RL4*minus_U3_yy - sr400_tree_geo_D4*U3_yx +
        minus_vd3_y;
    const modeler_lanes t84 = c3*minus_vd4_z;
    /* link 4: velocity of the origin, for unit speed of each joint below, m4 = R4' (m3 + e3 x p4)
        */
    const modeler_lanes minus_m4_3x = sr400_tree_geo_RL4*c3;
    const modeler_lanes m4_3y = sr400_tree_geo_RL4*s3;
    MODELER_PUT(93) = minus_U4_xx*minus_m4_3x + U4_yx*m4_3y + sr400_tree_geo_D4*U4_zx - t84;
    const modeler_lanes t87 = sr400_tree_geo_RL4 - m3_2x;
    const modeler_lanes minus_m4_2x = c3*t87;
    const modeler_lanes m4_2y = s3*t87;
    const modeler_lanes m4_2z = sr400_tree_geo_D4 + m3_2y;
    MODELER_PUT(65) = minus_U4_xx*minus_m4_2x + U4_yx*m4_2y + U4_zx*m4_2z - t84;
    const modeler_lanes t91 = sr400_tree_geo_D4*minus_e3_1y - sr400_tree_geo_RL4*minus_e3_1x +
        m3_1z;
    const modeler_lanes minus_m4_1x = s3*t91;
    const modeler_lanes minus_m4_1y = c3*t91;
    MODELER_PUT(18) = minus_vd4_z*e4_1y + minus_vd4_y*minus_e3_1y + (minus_U4_xx*minus_m4_1x -
        U4_yx*minus_m4_1y);
    const modeler_lanes minus_vd4_x = c3*minus_vd4a_x + s3*vd4a_z;
    MODELER_PUT(115) = minus_vd4_x;
    const modeler_lanes t95 = s3*minus_vd4_z;
    MODELER_PUT(94) = minus_U4_xy*minus_m4_3x - minus_U4_yy*m4_3y - sr400_tree_geo_D4*minus_U4_zy +
        t95;
    MODELER_PUT(66) = minus_U4_xy*minus_m4_2x - minus_U4_yy*m4_2y - minus_U4_zy*m4_2z + t95;
    MODELER_PUT(19) = minus_vd4_z*minus_e4_1x - minus_vd4_x*minus_e3_1y + (minus_U4_xy*minus_m4_1x +
        minus_U4_yy*minus_m4_1y);
    /* link 5: angular velocity, w5 = R5' w4 + qd5 z */
    const modeler_lanes minus_w5_x = c4*minus_w4_x - s4*w4_z;
    const modeler_lanes w5_y = c4*w4_z + s4*minus_w4_x;
    const modeler_lanes minus_ww5_xy = minus_w5_x*w5_y;
    MODELER_PUT(130) = minus_ww5_xy;
    /* link 5: angular acceleration, wd5 = R5' wd4 + (R5' w4) x qd5 z + qdd5 z */
    const modeler_lanes minus_wd5_x = c4*minus_wd4_x - s4*wd4_z - qd_4*w5_y;
    const modeler_lanes w5_z = qd_4 + minus_w4_y;
    const modeler_lanes minus_ww5_xz = minus_w5_x*w5_z;
    const modeler_lanes t102 = c4*minus_ww5_xz;
    MODELER_PUT(116) = -(s4*minus_wd5_x + t102);
    /* link 5: axes of the joints below, for unit speed of each, e5 = R5' e4 */
    const modeler_lanes minus_e5_2x = s3*c4;
    const modeler_lanes e5_2y = s3*s4;
    const modeler_lanes t105 = minus_ww5_xz*e5_2y;
    const modeler_lanes t106 = minus_wd5_x*minus_e5_2x - t105 + c3*minus_ww5_xy;
    MODELER_PUT(95) = t106;
    MODELER_PUT(67) = t106;
    const modeler_lanes minus_e5_1x = c4*minus_e4_1x + s4*minus_e3_1y;
    const modeler_lanes minus_e5_1y = c4*minus_e3_1y - s4*minus_e4_1x;
    const modeler_lanes t109 = minus_ww5_xz*minus_e5_1y;
    MODELER_PUT(20) = minus_wd5_x*minus_e5_1x + t109 - minus_ww5_xy*e4_1y;
    const modeler_lanes ww5_zz = w5_z*w5_z;
    /* link 5: acceleration of points of the link, U5 = [wd5 x] + [w5 x][w5 x] */
    const modeler_lanes minus_U5_xx = w5_y*w5_y + ww5_zz;
    const modeler_lanes minus_U5_yy = minus_w5_x*minus_w5_x + ww5_zz;
    /* link 5: moment on the link at its origin for one unit of a parameter, n5 = J5 wd5 + w5 x J5
        w5 + MS5 x vd5 */
    const modeler_lanes minus_n5_XYz = minus_U5_xx - minus_U5_yy;
    MODELER_PUT(131) = -minus_n5_XYz;
    const modeler_lanes wd5_y = c4*wd4_z + s4*minus_wd4_x + qd_4*minus_w5_x;
    const modeler_lanes minus_U5_zx = wd5_y + minus_ww5_xz;
    const modeler_lanes ww5_yz = w5_y*w5_z;
    const modeler_lanes minus_U5_zy = minus_wd5_x - ww5_yz;
    MODELER_PUT(117) = s4*minus_U5_zx - c4*minus_U5_zy;
    const modeler_lanes t118 = minus_U5_zx*minus_e5_2x + minus_U5_zy*e5_2y + c3*minus_n5_XYz;
    MODELER_PUT(96) = -t118;
    MODELER_PUT(68) = -t118;
    MODELER_PUT(21) = e4_1y*minus_n5_XYz - (minus_U5_zx*minus_e5_1x - minus_U5_zy*minus_e5_1y);
    const modeler_lanes U5_yz = minus_wd5_x + ww5_yz;
    MODELER_PUT(132) = -U5_yz;
    const modeler_lanes wd5_z = qdd_4 + minus_wd4_y;
    const modeler_lanes U5_yx = wd5_z - minus_ww5_xy;
    const modeler_lanes minus_n5_XZy = minus_U4_yy - minus_U5_xx;
    MODELER_PUT(118) = s4*U5_yx - c4*minus_n5_XZy;
    const modeler_lanes t123 = U5_yx*minus_e5_2x + e5_2y*minus_n5_XZy + c3*U5_yz;
    MODELER_PUT(97) = -t123;
    MODELER_PUT(69) = -t123;
    MODELER_PUT(22) = U5_yz*e4_1y - (U5_yx*minus_e5_1x - minus_e5_1y*minus_n5_XZy);
    const modeler_lanes U5_xz = wd5_y - minus_ww5_xz;
    MODELER_PUT(133) = U5_xz;
    const modeler_lanes n5_YZx = minus_U4_yy - minus_U5_yy;
    const modeler_lanes minus_U5_xy = wd5_z + minus_ww5_xy;
    MODELER_PUT(119) = s4*n5_YZx + c4*minus_U5_xy;
    const modeler_lanes t127 = minus_e5_2x*n5_YZx - minus_U5_xy*e5_2y - c3*U5_xz;
    MODELER_PUT(98) = -t127;
    MODELER_PUT(70) = -t127;
    MODELER_PUT(23) = -(minus_e5_1x*n5_YZx + minus_U5_xy*minus_e5_1y + U5_xz*e4_1y);
    MODELER_PUT(134) = wd5_z;
    MODELER_PUT(120) = t102 + s4*ww5_yz;
    const modeler_lanes t128 = t105 - ww5_yz*minus_e5_2x + c3*wd5_z;
    MODELER_PUT(99) = t128;
    MODELER_PUT(71) = t128;
    MODELER_PUT(24) = -(t109 + ww5_yz*minus_e5_1x + wd5_z*e4_1y);
    /* link 5: acceleration of the origin less gravity, vd5 = R5' (vd4 + U4 p5) */
    const modeler_lanes minus_vd5_y = c4*minus_vd4_z - s4*minus_vd4_x;
    MODELER_PUT(135) = -minus_vd5_y;
    MODELER_PUT(121) = -c4*minus_vd4_y;
    const modeler_lanes t130 = minus_vd4_y*e5_2y + c3*minus_vd5_y;
    /* link 5: velocity of the origin, for unit speed of each joint below, m5 = R5' (m4 + e4 x p5)
        */
    const modeler_lanes minus_m5_3x = c4*minus_m4_3x - sr400_tree_geo_D4*s4;
    const modeler_lanes m5_3y = sr400_tree_geo_D4*c4 + s4*minus_m4_3x;
    MODELER_PUT(100) = minus_U5_xx*minus_m5_3x + U5_yx*m5_3y + minus_U5_zx*m4_3y - t130;
    const modeler_lanes minus_m5_2x = c4*minus_m4_2x - s4*m4_2z;
    const modeler_lanes m5_2y = c4*m4_2z + s4*minus_m4_2x;
    MODELER_PUT(72) = minus_U5_xx*minus_m5_2x + U5_yx*m5_2y + minus_U5_zx*m4_2y - t130;
    const modeler_lanes minus_m5_1x = c4*minus_m4_1x;
    const modeler_lanes m5_1y = s4*minus_m4_1x;
    MODELER_PUT(25) = minus_vd4_y*minus_e5_1y + minus_vd5_y*e4_1y + (minus_U5_xx*minus_m5_1x +
        U5_yx*m5_1y - minus_U5_zx*minus_m4_1y);
    const modeler_lanes minus_vd5_x = c4*minus_vd4_x + s4*minus_vd4_z;
    MODELER_PUT(136) = minus_vd5_x;
    MODELER_PUT(122) = s4*minus_vd4_y;
    const modeler_lanes t138 = minus_vd4_y*minus_e5_2x - c3*minus_vd5_x;
    MODELER_PUT(101) = minus_U5_xy*minus_m5_3x - minus_U5_yy*m5_3y + minus_U5_zy*m4_3y - t138;
    MODELER_PUT(73) = minus_U5_xy*minus_m5_2x - minus_U5_yy*m5_2y + minus_U5_zy*m4_2y - t138;
    MODELER_PUT(26) = minus_U5_xy*minus_m5_1x - minus_U5_yy*m5_1y - minus_U5_zy*minus_m4_1y -
        (minus_vd4_y*minus_e5_1x + minus_vd5_x*e4_1y);
    /* link 6: angular velocity, w6 = R6' w5 + qd6 z */
    const modeler_lanes minus_w6_x = c5*minus_w5_x + s5*w5_z;
    const modeler_lanes minus_w6_y = c5*w5_z - s5*minus_w5_x;
    const modeler_lanes ww6_xy = minus_w6_x*minus_w6_y;
    MODELER_PUT(144) = -ww6_xy;
    /* link 6: angular acceleration, wd6 = R6' wd5 + (R6' w5) x qd6 z + qdd6 z */
    const modeler_lanes minus_wd6_x = c5*minus_wd5_x + s5*wd5_z + qd_5*minus_w6_y;
    const modeler_lanes w6_z = qd_5 + w5_y;
    const modeler_lanes minus_ww6_xz = minus_w6_x*w6_z;
    const modeler_lanes t145 = c5*minus_ww6_xz;
    MODELER_PUT(137) = s5*minus_wd6_x + t145;
    /* link 6: axes of the joints below, for unit speed of each, e6 = R6' e5 */
    const modeler_lanes e6_4x = s4*c5;
    const modeler_lanes minus_e6_4y = s4*s5;
    const modeler_lanes t148 = minus_ww6_xz*minus_e6_4y;
    MODELER_PUT(123) = -(minus_wd6_x*e6_4x - t148 + c4*ww6_xy);
    const modeler_lanes minus_e6_2x = c5*minus_e5_2x + c3*s5;
    const modeler_lanes minus_e6_2y = c3*c5 - s5*minus_e5_2x;
    const modeler_lanes t151 = minus_ww6_xz*minus_e6_2y;
    const modeler_lanes t152 = minus_wd6_x*minus_e6_2x + t151 - ww6_xy*e5_2y;
    MODELER_PUT(102) = t152;
    MODELER_PUT(74) = t152;
    const modeler_lanes minus_e6_1x = c5*minus_e5_1x - s5*e4_1y;
    const modeler_lanes e6_1y = c5*e4_1y + s5*minus_e5_1x;
    const modeler_lanes t155 = minus_ww6_xz*e6_1y;
    MODELER_PUT(27) = minus_wd6_x*minus_e6_1x - t155 + ww6_xy*minus_e5_1y;
    const modeler_lanes ww6_zz = w6_z*w6_z;
    /* link 6: acceleration of points of the link, U6 = [wd6 x] + [w6 x][w6 x] */
    const modeler_lanes minus_U6_xx = minus_w6_y*minus_w6_y + ww6_zz;
    const modeler_lanes minus_U6_yy = minus_w6_x*minus_w6_x + ww6_zz;
    /* link 6: moment on the link at its origin for one unit of a parameter, n6 = J6 wd6 + w6 x J6
        w6 + MS6 x vd6 */
    const modeler_lanes minus_n6_XYz = minus_U6_xx - minus_U6_yy;
    MODELER_PUT(145) = -minus_n6_XYz;
    const modeler_lanes minus_wd6_y = c5*wd5_z - s5*minus_wd5_x - qd_5*minus_w6_x;
    const modeler_lanes U6_zx = minus_wd6_y - minus_ww6_xz;
    const modeler_lanes minus_ww6_yz = minus_w6_y*w6_z;
    const modeler_lanes minus_U6_zy = minus_wd6_x + minus_ww6_yz;
    MODELER_PUT(138) = s5*U6_zx + c5*minus_U6_zy;
    MODELER_PUT(124) = -(U6_zx*e6_4x - minus_U6_zy*minus_e6_4y + c4*minus_n6_XYz);
    const modeler_lanes t164 = U6_zx*minus_e6_2x + minus_U6_zy*minus_e6_2y - e5_2y*minus_n6_XYz;
    MODELER_PUT(103) = t164;
    MODELER_PUT(75) = t164;
    MODELER_PUT(28) = U6_zx*minus_e6_1x - minus_U6_zy*e6_1y + minus_e5_1y*minus_n6_XYz;
    const modeler_lanes U6_yz = minus_wd6_x - minus_ww6_yz;
    MODELER_PUT(146) = -U6_yz;
    const modeler_lanes wd6_z = qdd_5 + wd5_y;
    const modeler_lanes U6_yx = wd6_z + ww6_xy;
    const modeler_lanes minus_n6_XZy = minus_U5_yy - minus_U6_xx;
    MODELER_PUT(139) = c5*minus_n6_XZy - s5*U6_yx;
    MODELER_PUT(125) = U6_yx*e6_4x + minus_e6_4y*minus_n6_XZy - c4*U6_yz;
    const modeler_lanes t169 = U6_yx*minus_e6_2x - minus_e6_2y*minus_n6_XZy + U6_yz*e5_2y;
    MODELER_PUT(104) = -t169;
    MODELER_PUT(76) = -t169;
    MODELER_PUT(29) = U6_yz*minus_e5_1y - (U6_yx*minus_e6_1x + e6_1y*minus_n6_XZy);
    const modeler_lanes minus_U6_xz = minus_wd6_y + minus_ww6_xz;
    MODELER_PUT(147) = -minus_U6_xz;
    const modeler_lanes n6_YZx = minus_U5_yy - minus_U6_yy;
    const modeler_lanes minus_U6_xy = wd6_z - ww6_xy;
    MODELER_PUT(140) = -(s5*n6_YZx + c5*minus_U6_xy);
    MODELER_PUT(126) = e6_4x*n6_YZx - minus_U6_xy*minus_e6_4y - c4*minus_U6_xz;
    const modeler_lanes t173 = minus_e6_2x*n6_YZx + minus_U6_xy*minus_e6_2y + minus_U6_xz*e5_2y;
    MODELER_PUT(105) = -t173;
    MODELER_PUT(77) = -t173;
    MODELER_PUT(30) = minus_U6_xz*minus_e5_1y - (minus_e6_1x*n6_YZx - minus_U6_xy*e6_1y);
    MODELER_PUT(148) = wd6_z;
    MODELER_PUT(141) = s5*minus_ww6_yz - t145;
    MODELER_PUT(127) = c4*wd6_z - (t148 + minus_ww6_yz*e6_4x);
    const modeler_lanes t174 = t151 - minus_ww6_yz*minus_e6_2x - wd6_z*e5_2y;
    MODELER_PUT(106) = -t174;
    MODELER_PUT(78) = -t174;
    MODELER_PUT(31) = t155 + minus_ww6_yz*minus_e6_1x - wd6_z*minus_e5_1y;
    /* link 6: acceleration of the origin less gravity, vd6 = R6' (vd5 + U5 p6) */
    const modeler_lanes minus_vd6_y = c5*minus_vd4_y - s5*minus_vd5_x;
    MODELER_PUT(149) = -minus_vd6_y;
    MODELER_PUT(142) = -c5*minus_vd5_y;
    MODELER_PUT(128) = -(minus_vd5_y*minus_e6_4y + c4*minus_vd6_y);
    const modeler_lanes t176 = minus_vd5_y*minus_e6_2y + minus_vd6_y*e5_2y;
    /* link 6: velocity of the origin, for unit speed of each joint below, m6 = R6' (m5 + e5 x p6)
        */
    const modeler_lanes minus_m6_3x = c5*minus_m5_3x - s5*m4_3y;
    const modeler_lanes m6_3y = c5*m4_3y + s5*minus_m5_3x;
    MODELER_PUT(107) = minus_U6_xx*minus_m6_3x + U6_yx*m6_3y + U6_zx*m5_3y - t176;
    const modeler_lanes minus_m6_2x = c5*minus_m5_2x - s5*m4_2y;
    const modeler_lanes m6_2y = c5*m4_2y + s5*minus_m5_2x;
    MODELER_PUT(79) = minus_U6_xx*minus_m6_2x + U6_yx*m6_2y + U6_zx*m5_2y - t176;
    const modeler_lanes minus_m6_1x = c5*minus_m5_1x + s5*minus_m4_1y;
    const modeler_lanes minus_m6_1y = c5*minus_m4_1y - s5*minus_m5_1x;
    MODELER_PUT(32) = minus_vd5_y*e6_1y + minus_vd6_y*minus_e5_1y + (minus_U6_xx*minus_m6_1x -
        U6_yx*minus_m6_1y + U6_zx*m5_1y);
    const modeler_lanes minus_vd6_x = c5*minus_vd5_x + s5*minus_vd4_y;
    MODELER_PUT(150) = minus_vd6_x;
    MODELER_PUT(143) = s5*minus_vd5_y;
    MODELER_PUT(129) = c4*minus_vd6_x - minus_vd5_y*e6_4x;
    const modeler_lanes t184 = minus_vd5_y*minus_e6_2x + minus_vd6_x*e5_2y;
    MODELER_PUT(108) = minus_U6_xy*minus_m6_3x - minus_U6_yy*m6_3y - minus_U6_zy*m5_3y + t184;
    MODELER_PUT(80) = minus_U6_xy*minus_m6_2x - minus_U6_yy*m6_2y - minus_U6_zy*m5_2y + t184;
    MODELER_PUT(33) = minus_vd5_y*minus_e6_1x - minus_vd6_x*minus_e5_1y + (minus_U6_xy*minus_m6_1x +
        minus_U6_yy*minus_m6_1y - minus_U6_zy*m5_1y);
    /* link 7: angular velocity, w7 = R7' w1 + qd7 z */
    const modeler_lanes minus_w7_x = s6*qd_0;
    const modeler_lanes minus_w7_y = c6*qd_0;
    const modeler_lanes ww7_xy = minus_w7_x*minus_w7_y;
    MODELER_PUT(151) = -ww7_xy;
    /* link 7: acceleration of points of the link, U7 = [wd7 x] + [w7 x][w7 x] */
    const modeler_lanes U7_yz = s6*qdd_0;
    const modeler_lanes minus_ww7_yz = qd_6*minus_w7_y;
    /* link 7: angular acceleration, wd7 = R7' wd1 + (R7' w1) x qd7 z + qdd7 z */
    const modeler_lanes minus_wd7_x = U7_yz + minus_ww7_yz;
    const modeler_lanes minus_ww7_xz = qd_6*minus_w7_x;
    MODELER_PUT(34) = s6*minus_wd7_x + c6*minus_ww7_xz;
    const modeler_lanes ww7_zz = qd_6*qd_6;
    const modeler_lanes minus_U7_xx = minus_w7_y*minus_w7_y + ww7_zz;
    const modeler_lanes minus_U7_yy = minus_w7_x*minus_w7_x + ww7_zz;
    MODELER_PUT(152) = minus_U7_yy - minus_U7_xx;
    const modeler_lanes minus_U7_xz = c6*qdd_0;
    const modeler_lanes minus_wd7_y = minus_U7_xz - minus_ww7_xz;
    const modeler_lanes minus_U7_zx = minus_ww7_xz - minus_wd7_y;
    const modeler_lanes minus_U7_zy = minus_ww7_yz + minus_wd7_x;
    MODELER_PUT(35) = c6*minus_U7_zy - s6*minus_U7_zx;
    MODELER_PUT(153) = -U7_yz;
    const modeler_lanes U7_yx = qdd_6 + ww7_xy;
    MODELER_PUT(36) = c6*(ww1_zz - minus_U7_xx) - s6*U7_yx;
    MODELER_PUT(154) = -minus_U7_xz;
    MODELER_PUT(37) = -(s6*(ww1_zz - minus_U7_yy) + c6*(qdd_6 - ww7_xy));
    MODELER_PUT(155) = qdd_6;
    /* link 7: acceleration of the origin less gravity, vd7 = R7' (vd1 + U1 p7) */
    const modeler_lanes minus_vd7_y = sr400_tree_geo_g*c6 - s6*minus_vd2a_x;
    MODELER_PUT(156) = -minus_vd7_y;
    MODELER_PUT(38) = c6*vd2_z - sr400_tree_geo_D2*minus_U7_zx;
    const modeler_lanes minus_vd7_x = c6*minus_vd2a_x + sr400_tree_geo_g*s6;
    MODELER_PUT(157) = minus_vd7_x;
    MODELER_PUT(39) = -(s6*vd2_z + sr400_tree_geo_D2*minus_U7_zy);
    /* link 8: angular velocity, w8 = R8' w7 + qd8 z */
    const modeler_lanes minus_w8_x = c7*minus_w7_x + s7*minus_w7_y;
    const modeler_lanes minus_w8_y = c7*minus_w7_y - s7*minus_w7_x;
    const modeler_lanes ww8_xy = minus_w8_x*minus_w8_y;
    MODELER_PUT(165) = -ww8_xy;
    MODELER_PUT(158) = -ww8_xy;
    /* link 8: angular acceleration, wd8 = R8' wd7 + (R8' w7) x qd8 z + qdd8 z */
    const modeler_lanes minus_wd8_x = c7*minus_wd7_x + s7*minus_wd7_y + qd_7*minus_w8_y;
    /* link 8: axes of the joints below, for unit speed of each, e8 = R8' e7 */
    const modeler_lanes minus_e8_1x = s6*c7 + c6*s7;
    const modeler_lanes w8_z = qd_6 + qd_7;
    const modeler_lanes minus_ww8_xz = minus_w8_x*w8_z;
    const modeler_lanes minus_e8_1y = c6*c7 - s6*s7;
    MODELER_PUT(40) = minus_wd8_x*minus_e8_1x + minus_ww8_xz*minus_e8_1y;
    const modeler_lanes ww8_zz = w8_z*w8_z;
    /* link 8: acceleration of points of the link, U8 = [wd8 x] + [w8 x][w8 x] */
    const modeler_lanes minus_U8_xx = minus_w8_y*minus_w8_y + ww8_zz;
    const modeler_lanes minus_U8_yy = minus_w8_x*minus_w8_x + ww8_zz;
    /* link 8: moment on the link at its origin for one unit of a parameter, n8 = J8 wd8 + w8 x J8
        w8 + MS8 x vd8 */
    const modeler_lanes minus_n8_XYz = minus_U8_xx - minus_U8_yy;
    MODELER_PUT(166) = -minus_n8_XYz;
    MODELER_PUT(159) = -minus_n8_XYz;
    const modeler_lanes minus_wd8_y = c7*minus_wd7_y - s7*minus_wd7_x - qd_7*minus_w8_x;
    const modeler_lanes U8_zx = minus_wd8_y - minus_ww8_xz;
    const modeler_lanes minus_ww8_yz = minus_w8_y*w8_z;
    const modeler_lanes minus_U8_zy = minus_wd8_x + minus_ww8_yz;
    MODELER_PUT(41) = U8_zx*minus_e8_1x + minus_U8_zy*minus_e8_1y;
    const modeler_lanes U8_yz = minus_wd8_x - minus_ww8_yz;
    MODELER_PUT(167) = -U8_yz;
    MODELER_PUT(160) = -U8_yz;
    const modeler_lanes wd8_z = qdd_6 + qdd_7;
    const modeler_lanes U8_yx = wd8_z + ww8_xy;
    MODELER_PUT(42) = minus_e8_1y*(ww1_zz - minus_U8_xx) - U8_yx*minus_e8_1x;
    const modeler_lanes minus_U8_xz = minus_wd8_y + minus_ww8_xz;
    MODELER_PUT(168) = -minus_U8_xz;
    MODELER_PUT(161) = -minus_U8_xz;
    const modeler_lanes minus_U8_xy = wd8_z - ww8_xy;
    MODELER_PUT(43) = -(minus_e8_1x*(ww1_zz - minus_U8_yy) + minus_U8_xy*minus_e8_1y);
    MODELER_PUT(169) = wd8_z;
    MODELER_PUT(162) = wd8_z;
    /* link 8: acceleration of the origin less gravity, vd8 = R8' (vd7 + U7 p8) */
    const modeler_lanes minus_vd8a_y = minus_vd7_y - sr400_tree_geo_D8*U7_yx;
    const modeler_lanes minus_vd8a_x = minus_vd7_x + sr400_tree_geo_D8*minus_U7_xx;
    const modeler_lanes minus_vd8_y = c7*minus_vd8a_y - s7*minus_vd8a_x;
    MODELER_PUT(170) = -minus_vd8_y;
    /* link 8: velocity of the origin, for unit speed of each joint below, m8 = R8' (m7 + e7 x p8)
        */
    const modeler_lanes m8_7x = sr400_tree_geo_D8*s7;
    const modeler_lanes m8_7y = sr400_tree_geo_D8*c7;
    MODELER_PUT(163) = -(minus_U8_xx*m8_7x - U8_yx*m8_7y + minus_vd8_y);
    const modeler_lanes vd8_z = vd2_z - sr400_tree_geo_D8*minus_U7_zx;
    const modeler_lanes m8_1z = sr400_tree_geo_D2 + sr400_tree_geo_D8*c6;
    MODELER_PUT(44) = vd8_z*minus_e8_1y + U8_zx*m8_1z;
    const modeler_lanes minus_vd8_x = c7*minus_vd8a_x + s7*minus_vd8a_y;
    MODELER_PUT(171) = minus_vd8_x;
    MODELER_PUT(164) = minus_vd8_x - (minus_U8_xy*m8_7x + minus_U8_yy*m8_7y);
    MODELER_PUT(45) = -(vd8_z*minus_e8_1x + minus_U8_zy*m8_1z);
}

MODELER_TARGET static void MODELER_VERSION(tile)(const double *q, const double *qd,
                                                 const double *qdd, const double *s, double *values)
{
    for (int lane = 0; lane < MODELER_LANES; lane += MODELER_WIDTH) {
        MODELER_VERSION(entries)(q, qd, qdd, s, values + lane);
        q += 8*MODELER_WIDTH;
        qd += 8*MODELER_WIDTH;
        qdd += 8*MODELER_WIDTH;
    }
}

#endif
