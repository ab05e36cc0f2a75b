/* One leg of the Orthoglide, cut open
 *
 * Functions of orthoglide_leg_tree_tile.h.
 * This file includes itself once for every instruction set.
 * Temporaries are named as in orthoglide_leg_tree_base_regressor.c.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#ifndef MODELER_VERSION

#include "orthoglide_leg_tree_tile.h"

/* Geometry; see orthoglide_leg_tree.c. */
#ifndef ORTHOGLIDE_LEG_TREE_GEO_g
#define ORTHOGLIDE_LEG_TREE_GEO_g 9.81
#endif
#ifndef ORTHOGLIDE_LEG_TREE_GEO_D4
#define ORTHOGLIDE_LEG_TREE_GEO_D4 0.31
#endif
#ifndef ORTHOGLIDE_LEG_TREE_GEO_b3
#define ORTHOGLIDE_LEG_TREE_GEO_b3 (-0.04)
#endif
#ifndef ORTHOGLIDE_LEG_TREE_GEO_b7
#define ORTHOGLIDE_LEG_TREE_GEO_b7 0.04
#endif

static const double orthoglide_leg_tree_geo_g = ORTHOGLIDE_LEG_TREE_GEO_g;
static const double orthoglide_leg_tree_geo_D4 = ORTHOGLIDE_LEG_TREE_GEO_D4;

#define MODELER_BODY "orthoglide_leg_tree_tile.c"
#include "modeler_versions.h"

static const int row[] = {
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1,
    1, 1, 1, 1, 1, 1, 1, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 3, 3, 3, 3,
    3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 4, 4, 4, 4, 4, 4, 4, 5, 5, 5, 5, 5, 5, 5
};

static const int column[] = {
    0, 2, 3, 9, 10, 16, 17, 23, 24, 30, 31, 1, 2, 3, 4, 5, 6, 7, 9, 10, 11, 12, 13, 14, 16, 17, 18,
    19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 30, 31, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16,
    17, 18, 19, 20, 21, 22, 23, 24, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 18, 19,
    20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31
};

#define TILED(version) \
    {6, 32, 0, 88, row, column, tile_##version, NULL, 0, NULL}

static const modeler_tiled tiled[] = {MODELER_EACH_VERSION(TILED)};

const modeler_tiled *orthoglide_leg_tree_tiled(void)
{
    return &tiled[MODELER_BEST_VERSION];
}

const char *orthoglide_leg_tree_tile_signature(void)
{
    return "3decae1a5d54f2a6";
}

#else /* for one instruction set */

#include "modeler_lanes.h"

/* MODELER_WIDTH samples.
 * 140 additions, 202 multiplications for each. */
MODELER_INLINE void MODELER_VERSION(entries)(const double *q, const double *qd, const double *qdd,
                                             const double *s, double *values)
{
    (void)s;

    const modeler_lanes q_1 = MODELER_ROWS(q, 6, 1);
    const modeler_lanes q_2 = MODELER_ROWS(q, 6, 2);
    const modeler_lanes q_3 = MODELER_ROWS(q, 6, 3);
    const modeler_lanes q_4 = MODELER_ROWS(q, 6, 4);
    const modeler_lanes q_5 = MODELER_ROWS(q, 6, 5);
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
    modeler_lanes s2, c2;
    modeler_lanes_sincos(q_2, &s2, &c2);
    modeler_lanes s3, c3;
    modeler_lanes_sincos(q_3, &s3, &c3);
    modeler_lanes s4, c4;
    modeler_lanes_sincos(q_4, &s4, &c4);
    modeler_lanes s5, c5;
    modeler_lanes_sincos(q_5, &s5, &c5);

    MODELER_PUT(0) = qdd_0;
    MODELER_PUT(11) = qdd_1;
    /* link 2: acceleration of the origin less gravity, vd2 = R2' (vd1 + U1 p2) */
    const modeler_lanes minus_vd2_y = c1*qdd_0;
    MODELER_PUT(12) = -minus_vd2_y;
    const modeler_lanes ww2_zz = qd_1*qd_1;
    MODELER_PUT(1) = s1*ww2_zz - c1*qdd_1;
    const modeler_lanes minus_vd2_x = s1*qdd_0;
    MODELER_PUT(13) = minus_vd2_x;
    MODELER_PUT(2) = s1*qdd_1 + c1*ww2_zz;
    /* link 3: angular velocity, w3 = R3' w2 + qd3 z */
    const modeler_lanes minus_w3_x = s2*qd_1;
    const modeler_lanes minus_w3_y = c2*qd_1;
    const modeler_lanes ww3_xy = minus_w3_x*minus_w3_y;
    MODELER_PUT(39) = -ww3_xy;
    /* link 3: acceleration of points of the link, U3 = [wd3 x] + [w3 x][w3 x] */
    const modeler_lanes U3_yz = s2*qdd_1;
    const modeler_lanes minus_ww3_yz = qd_2*minus_w3_y;
    /* link 3: angular acceleration, wd3 = R3' wd2 + (R3' w2) x qd3 z + qdd3 z */
    const modeler_lanes minus_wd3_x = U3_yz + minus_ww3_yz;
    const modeler_lanes minus_ww3_xz = qd_2*minus_w3_x;
    MODELER_PUT(14) = s2*minus_wd3_x + c2*minus_ww3_xz;
    const modeler_lanes ww3_zz = qd_2*qd_2;
    const modeler_lanes minus_U3_xx = minus_w3_y*minus_w3_y + ww3_zz;
    const modeler_lanes minus_U3_yy = minus_w3_x*minus_w3_x + ww3_zz;
    MODELER_PUT(40) = minus_U3_yy - minus_U3_xx;
    const modeler_lanes minus_U3_xz = c2*qdd_1;
    const modeler_lanes minus_wd3_y = minus_U3_xz - minus_ww3_xz;
    const modeler_lanes minus_U3_zx = minus_ww3_xz - minus_wd3_y;
    const modeler_lanes minus_U3_zy = minus_ww3_yz + minus_wd3_x;
    MODELER_PUT(15) = c2*minus_U3_zy - s2*minus_U3_zx;
    MODELER_PUT(41) = -U3_yz;
    const modeler_lanes U3_yx = qdd_2 + ww3_xy;
    MODELER_PUT(16) = c2*(ww2_zz - minus_U3_xx) - s2*U3_yx;
    MODELER_PUT(42) = -minus_U3_xz;
    const modeler_lanes minus_U3_xy = qdd_2 - ww3_xy;
    MODELER_PUT(17) = -(s2*(ww2_zz - minus_U3_yy) + c2*minus_U3_xy);
    MODELER_PUT(43) = qdd_2;
    /* link 3: acceleration of the origin less gravity, vd3 = R3' (vd2 + U2 p3) */
    const modeler_lanes vd3_y = orthoglide_leg_tree_geo_g*c2 + s2*minus_vd2_x;
    MODELER_PUT(44) = vd3_y;
    MODELER_PUT(18) = -c2*minus_vd2_y;
    /* link 3: velocity of the origin, for unit speed of each joint below, m3 = R3' (m2 + e2 x p3)
        */
    const modeler_lanes minus_m3_1x = s1*c2;
    const modeler_lanes m3_1y = s1*s2;
    MODELER_PUT(3) = minus_U3_xx*minus_m3_1x + U3_yx*m3_1y + c1*minus_U3_zx;
    const modeler_lanes minus_vd3_x = c2*minus_vd2_x - orthoglide_leg_tree_geo_g*s2;
    MODELER_PUT(45) = minus_vd3_x;
    MODELER_PUT(19) = s2*minus_vd2_y;
    MODELER_PUT(4) = minus_U3_xy*minus_m3_1x - minus_U3_yy*m3_1y + c1*minus_U3_zy;
    /* link 4: angular velocity, w4 = R4' w3 + qd4 z */
    const modeler_lanes minus_w4_x = c3*minus_w3_x + s3*minus_w3_y;
    const modeler_lanes minus_w4_y = c3*minus_w3_y - s3*minus_w3_x;
    const modeler_lanes ww4_xy = minus_w4_x*minus_w4_y;
    MODELER_PUT(60) = -ww4_xy;
    MODELER_PUT(46) = -ww4_xy;
    /* link 4: angular acceleration, wd4 = R4' wd3 + (R4' w3) x qd4 z + qdd4 z */
    const modeler_lanes minus_wd4_x = c3*minus_wd3_x + s3*minus_wd3_y + qd_3*minus_w4_y;
    /* link 4: axes of the joints below, for unit speed of each, e4 = R4' e3 */
    const modeler_lanes minus_e4_2x = s2*c3 + c2*s3;
    const modeler_lanes w4_z = qd_2 + qd_3;
    const modeler_lanes minus_ww4_xz = minus_w4_x*w4_z;
    const modeler_lanes minus_e4_2y = c2*c3 - s2*s3;
    MODELER_PUT(20) = minus_wd4_x*minus_e4_2x + minus_ww4_xz*minus_e4_2y;
    const modeler_lanes ww4_zz = w4_z*w4_z;
    /* link 4: acceleration of points of the link, U4 = [wd4 x] + [w4 x][w4 x] */
    const modeler_lanes minus_U4_xx = minus_w4_y*minus_w4_y + ww4_zz;
    const modeler_lanes minus_U4_yy = minus_w4_x*minus_w4_x + ww4_zz;
    /* link 4: moment on the link at its origin for one unit of a parameter, n4 = J4 wd4 + w4 x J4
        w4 + MS4 x vd4 */
    const modeler_lanes minus_n4_XYz = minus_U4_xx - minus_U4_yy;
    MODELER_PUT(61) = -minus_n4_XYz;
    MODELER_PUT(47) = -minus_n4_XYz;
    const modeler_lanes minus_wd4_y = c3*minus_wd3_y - s3*minus_wd3_x - qd_3*minus_w4_x;
    const modeler_lanes U4_zx = minus_wd4_y - minus_ww4_xz;
    const modeler_lanes minus_ww4_yz = minus_w4_y*w4_z;
    const modeler_lanes minus_U4_zy = minus_wd4_x + minus_ww4_yz;
    MODELER_PUT(21) = U4_zx*minus_e4_2x + minus_U4_zy*minus_e4_2y;
    const modeler_lanes U4_yz = minus_wd4_x - minus_ww4_yz;
    MODELER_PUT(62) = -U4_yz;
    MODELER_PUT(48) = -U4_yz;
    const modeler_lanes wd4_z = qdd_2 + qdd_3;
    const modeler_lanes U4_yx = wd4_z + ww4_xy;
    MODELER_PUT(22) = minus_e4_2y*(ww2_zz - minus_U4_xx) - U4_yx*minus_e4_2x;
    const modeler_lanes minus_U4_xz = minus_wd4_y + minus_ww4_xz;
    MODELER_PUT(63) = -minus_U4_xz;
    MODELER_PUT(49) = -minus_U4_xz;
    const modeler_lanes minus_U4_xy = wd4_z - ww4_xy;
    MODELER_PUT(23) = -(minus_e4_2x*(ww2_zz - minus_U4_yy) + minus_U4_xy*minus_e4_2y);
    MODELER_PUT(64) = wd4_z;
    MODELER_PUT(50) = wd4_z;
    /* link 4: acceleration of the origin less gravity, vd4 = R4' (vd3 + U3 p4) */
    const modeler_lanes vd4a_y = vd3_y + orthoglide_leg_tree_geo_D4*U3_yx;
    const modeler_lanes minus_vd4a_x = minus_vd3_x + orthoglide_leg_tree_geo_D4*minus_U3_xx;
    const modeler_lanes vd4_y = c3*vd4a_y + s3*minus_vd4a_x;
    MODELER_PUT(65) = vd4_y;
    /* link 4: velocity of the origin, for unit speed of each joint below, m4 = R4' (m3 + e3 x p4)
        */
    const modeler_lanes m4_3x = orthoglide_leg_tree_geo_D4*s3;
    const modeler_lanes m4_3y = orthoglide_leg_tree_geo_D4*c3;
    MODELER_PUT(51) = U4_yx*m4_3y - minus_U4_xx*m4_3x + vd4_y;
    const modeler_lanes minus_vd4_z = minus_vd2_y + orthoglide_leg_tree_geo_D4*minus_U3_zx;
    const modeler_lanes m4_2z = orthoglide_leg_tree_geo_D4*c2;
    MODELER_PUT(24) = U4_zx*m4_2z - minus_vd4_z*minus_e4_2y;
    const modeler_lanes minus_m4_1x = c3*minus_m3_1x - s3*m3_1y;
    const modeler_lanes m4_1y = c3*m3_1y + s3*minus_m3_1x;
    MODELER_PUT(5) = minus_U4_xx*minus_m4_1x + U4_yx*m4_1y - c1*U4_zx;
    const modeler_lanes minus_vd4_x = c3*minus_vd4a_x - s3*vd4a_y;
    MODELER_PUT(66) = minus_vd4_x;
    MODELER_PUT(52) = minus_vd4_x - (minus_U4_xy*m4_3x + minus_U4_yy*m4_3y);
    MODELER_PUT(25) = minus_vd4_z*minus_e4_2x - minus_U4_zy*m4_2z;
    MODELER_PUT(6) = minus_U4_xy*minus_m4_1x - minus_U4_yy*m4_1y + c1*minus_U4_zy;
    /* link 5: angular velocity, w5 = R5' w4 + qd5 z */
    const modeler_lanes minus_w5_x = c4*minus_w4_x - s4*w4_z;
    const modeler_lanes w5_y = c4*w4_z + s4*minus_w4_x;
    const modeler_lanes minus_ww5_xy = minus_w5_x*w5_y;
    MODELER_PUT(74) = minus_ww5_xy;
    /* link 5: angular acceleration, wd5 = R5' wd4 + (R5' w4) x qd5 z + qdd5 z */
    const modeler_lanes minus_wd5_x = c4*minus_wd4_x - s4*wd4_z - qd_4*w5_y;
    const modeler_lanes w5_z = qd_4 + minus_w4_y;
    const modeler_lanes minus_ww5_xz = minus_w5_x*w5_z;
    const modeler_lanes t61 = c4*minus_ww5_xz;
    const modeler_lanes t62 = s4*minus_wd5_x + t61;
    MODELER_PUT(67) = -t62;
    MODELER_PUT(53) = -t62;
    /* link 5: axes of the joints below, for unit speed of each, e5 = R5' e4 */
    const modeler_lanes minus_e5_2x = c4*minus_e4_2x;
    const modeler_lanes e5_2y = s4*minus_e4_2x;
    const modeler_lanes t65 = minus_ww5_xz*e5_2y;
    MODELER_PUT(26) = minus_wd5_x*minus_e5_2x - t65 + minus_ww5_xy*minus_e4_2y;
    const modeler_lanes ww5_zz = w5_z*w5_z;
    /* link 5: acceleration of points of the link, U5 = [wd5 x] + [w5 x][w5 x] */
    const modeler_lanes minus_U5_xx = w5_y*w5_y + ww5_zz;
    const modeler_lanes minus_U5_yy = minus_w5_x*minus_w5_x + ww5_zz;
    /* link 5: moment on the link at its origin for one unit of a parameter, n5 = J5 wd5 + w5 x J5
        w5 + MS5 x vd5 */
    const modeler_lanes minus_n5_XYz = minus_U5_xx - minus_U5_yy;
    MODELER_PUT(75) = -minus_n5_XYz;
    const modeler_lanes wd5_y = c4*wd4_z + s4*minus_wd4_x + qd_4*minus_w5_x;
    const modeler_lanes minus_U5_zx = wd5_y + minus_ww5_xz;
    const modeler_lanes ww5_yz = w5_y*w5_z;
    const modeler_lanes minus_U5_zy = minus_wd5_x - ww5_yz;
    const modeler_lanes t74 = s4*minus_U5_zx - c4*minus_U5_zy;
    MODELER_PUT(68) = t74;
    MODELER_PUT(54) = t74;
    MODELER_PUT(27) = -(minus_U5_zx*minus_e5_2x + minus_U5_zy*e5_2y + minus_e4_2y*minus_n5_XYz);
    const modeler_lanes U5_yz = minus_wd5_x + ww5_yz;
    MODELER_PUT(76) = -U5_yz;
    const modeler_lanes wd5_z = qdd_4 + minus_wd4_y;
    const modeler_lanes U5_yx = wd5_z - minus_ww5_xy;
    const modeler_lanes minus_n5_XZy = minus_U4_yy - minus_U5_xx;
    const modeler_lanes t79 = s4*U5_yx - c4*minus_n5_XZy;
    MODELER_PUT(69) = t79;
    MODELER_PUT(55) = t79;
    MODELER_PUT(28) = -(U5_yx*minus_e5_2x + e5_2y*minus_n5_XZy + U5_yz*minus_e4_2y);
    const modeler_lanes U5_xz = wd5_y - minus_ww5_xz;
    MODELER_PUT(77) = U5_xz;
    const modeler_lanes n5_YZx = minus_U4_yy - minus_U5_yy;
    const modeler_lanes minus_U5_xy = wd5_z + minus_ww5_xy;
    const modeler_lanes t83 = s4*n5_YZx + c4*minus_U5_xy;
    MODELER_PUT(70) = t83;
    MODELER_PUT(56) = t83;
    MODELER_PUT(29) = U5_xz*minus_e4_2y - (minus_e5_2x*n5_YZx - minus_U5_xy*e5_2y);
    MODELER_PUT(78) = wd5_z;
    const modeler_lanes t84 = t61 + s4*ww5_yz;
    MODELER_PUT(71) = t84;
    MODELER_PUT(57) = t84;
    MODELER_PUT(30) = t65 - ww5_yz*minus_e5_2x + wd5_z*minus_e4_2y;
    /* link 5: acceleration of the origin less gravity, vd5 = R5' (vd4 + U4 p5) */
    const modeler_lanes minus_vd5_y = c4*minus_vd4_z - s4*minus_vd4_x;
    MODELER_PUT(79) = -minus_vd5_y;
    const modeler_lanes t86 = c4*vd4_y;
    MODELER_PUT(72) = t86;
    /* link 5: velocity of the origin, for unit speed of each joint below, m5 = R5' (m4 + e4 x p5)
        */
    const modeler_lanes m5_3x = c4*m4_3x;
    const modeler_lanes minus_m5_3y = s4*m4_3x;
    MODELER_PUT(58) = minus_U5_zx*m4_3y - (minus_U5_xx*m5_3x + U5_yx*minus_m5_3y) + t86;
    const modeler_lanes m5_2x = s4*m4_2z;
    const modeler_lanes m5_2y = c4*m4_2z;
    MODELER_PUT(31) = vd4_y*e5_2y - minus_vd5_y*minus_e4_2y + (U5_yx*m5_2y - minus_U5_xx*m5_2x);
    const modeler_lanes minus_m5_1x = c4*minus_m4_1x + c1*s4;
    const modeler_lanes minus_m5_1y = c1*c4 - s4*minus_m4_1x;
    MODELER_PUT(7) = minus_U5_xx*minus_m5_1x - U5_yx*minus_m5_1y + minus_U5_zx*m4_1y;
    const modeler_lanes minus_vd5_x = c4*minus_vd4_x + s4*minus_vd4_z;
    MODELER_PUT(80) = minus_vd5_x;
    const modeler_lanes t94 = s4*vd4_y;
    MODELER_PUT(73) = -t94;
    MODELER_PUT(59) = -(minus_U5_xy*m5_3x - minus_U5_yy*minus_m5_3y - minus_U5_zy*m4_3y + t94);
    MODELER_PUT(32) = vd4_y*minus_e5_2x + minus_vd5_x*minus_e4_2y - (minus_U5_xy*m5_2x +
        minus_U5_yy*m5_2y);
    MODELER_PUT(8) = minus_U5_xy*minus_m5_1x + minus_U5_yy*minus_m5_1y + minus_U5_zy*m4_1y;
    /* link 7: angular velocity, w7 = R7' w2 + qd7 z */
    const modeler_lanes minus_w7_x = s5*qd_1;
    const modeler_lanes minus_w7_y = c5*qd_1;
    const modeler_lanes ww7_xy = minus_w7_x*minus_w7_y;
    MODELER_PUT(81) = -ww7_xy;
    /* link 7: acceleration of points of the link, U7 = [wd7 x] + [w7 x][w7 x] */
    const modeler_lanes U7_yz = s5*qdd_1;
    const modeler_lanes minus_ww7_yz = qd_5*minus_w7_y;
    /* link 7: angular acceleration, wd7 = R7' wd2 + (R7' w2) x qd7 z + qdd7 z */
    const modeler_lanes minus_wd7_x = U7_yz + minus_ww7_yz;
    const modeler_lanes minus_ww7_xz = qd_5*minus_w7_x;
    MODELER_PUT(33) = s5*minus_wd7_x + c5*minus_ww7_xz;
    const modeler_lanes ww7_zz = qd_5*qd_5;
    const modeler_lanes minus_U7_xx = minus_w7_y*minus_w7_y + ww7_zz;
    const modeler_lanes minus_U7_yy = minus_w7_x*minus_w7_x + ww7_zz;
    MODELER_PUT(82) = minus_U7_yy - minus_U7_xx;
    const modeler_lanes minus_U7_xz = c5*qdd_1;
    const modeler_lanes minus_U7_zx = minus_ww7_xz - minus_U7_xz + minus_ww7_xz;
    const modeler_lanes minus_U7_zy = minus_ww7_yz + minus_wd7_x;
    MODELER_PUT(34) = c5*minus_U7_zy - s5*minus_U7_zx;
    MODELER_PUT(83) = -U7_yz;
    const modeler_lanes U7_yx = qdd_5 + ww7_xy;
    MODELER_PUT(35) = c5*(ww2_zz - minus_U7_xx) - s5*U7_yx;
    MODELER_PUT(84) = -minus_U7_xz;
    const modeler_lanes minus_U7_xy = qdd_5 - ww7_xy;
    MODELER_PUT(36) = -(s5*(ww2_zz - minus_U7_yy) + c5*minus_U7_xy);
    MODELER_PUT(85) = qdd_5;
    MODELER_PUT(86) = orthoglide_leg_tree_geo_g*c5 + s5*minus_vd2_x;
    MODELER_PUT(37) = -c5*minus_vd2_y;
    /* link 7: velocity of the origin, for unit speed of each joint below, m7 = R7' (m2 + e2 x p7)
        */
    const modeler_lanes minus_m7_1x = s1*c5;
    const modeler_lanes m7_1y = s1*s5;
    MODELER_PUT(9) = minus_U7_xx*minus_m7_1x + U7_yx*m7_1y + c1*minus_U7_zx;
    MODELER_PUT(87) = c5*minus_vd2_x - orthoglide_leg_tree_geo_g*s5;
    MODELER_PUT(38) = s5*minus_vd2_y;
    MODELER_PUT(10) = minus_U7_xy*minus_m7_1x - minus_U7_yy*m7_1y + c1*minus_U7_zy;
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
