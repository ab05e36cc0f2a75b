/* 3R industrial wrist (Hanssen, Hovland, Brogardh)
 *
 * Functions of wrist_tile.h.
 * This file includes itself once for every instruction set.
 * Temporaries are named as in wrist_base_regressor.c.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#ifndef MODELER_VERSION

#include "wrist_tile.h"

/* Geometry; see wrist.c. */
#ifndef WRIST_GEO_g
#define WRIST_GEO_g 9.81
#endif
#ifndef WRIST_GEO_al1
#define WRIST_GEO_al1 0.2
#endif
#ifndef WRIST_GEO_bl1
#define WRIST_GEO_bl1 0.1
#endif

static const double wrist_geo_g = WRIST_GEO_g;
static const double wrist_geo_bl1 = WRIST_GEO_bl1;

#define MODELER_BODY "wrist_tile.c"
#include "modeler_versions.h"

static const int row[] = {
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 2, 2,
    2, 2, 2, 2, 2
};

static const int column[] = {
    0, 1, 2, 3, 4, 5, 6, 8, 9, 10, 11, 12, 13, 14, 15, 16, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14,
    15, 16, 10, 11, 12, 13, 14, 15, 16
};

#define TILED(version) \
    {3, 17, 0, 37, row, column, tile_##version, NULL, 0, NULL}

static const modeler_tiled tiled[] = {MODELER_EACH_VERSION(TILED)};

const modeler_tiled *wrist_tiled(void)
{
    return &tiled[MODELER_BEST_VERSION];
}

const char *wrist_tile_signature(void)
{
    return "04a9ce4bbacd538f";
}

#else /* for one instruction set */

#include "modeler_lanes.h"

/* MODELER_WIDTH samples.
 * 64 additions, 92 multiplications for each. */
MODELER_INLINE void MODELER_VERSION(entries)(const double *q, const double *qd, const double *qdd,
                                             const double *s, double *values)
{
    (void)s;

    const modeler_lanes q_0 = MODELER_ROWS(q, 3, 0);
    const modeler_lanes q_1 = MODELER_ROWS(q, 3, 1);
    const modeler_lanes q_2 = MODELER_ROWS(q, 3, 2);
    const modeler_lanes qd_0 = MODELER_ROWS(qd, 3, 0);
    const modeler_lanes qd_1 = MODELER_ROWS(qd, 3, 1);
    const modeler_lanes qd_2 = MODELER_ROWS(qd, 3, 2);
    const modeler_lanes qdd_0 = MODELER_ROWS(qdd, 3, 0);
    const modeler_lanes qdd_1 = MODELER_ROWS(qdd, 3, 1);
    const modeler_lanes qdd_2 = MODELER_ROWS(qdd, 3, 2);

    modeler_lanes s0, c0;
    modeler_lanes_sincos(q_0, &s0, &c0);
    modeler_lanes s1, c1;
    modeler_lanes_sincos(q_1, &s1, &c1);
    modeler_lanes s2, c2;
    modeler_lanes_sincos(q_2, &s2, &c2);

    MODELER_PUT(0) = qdd_0;
    /* link 1: acceleration of the origin less gravity, vd1 = R1' (vd0 + U0 p1) */
    const modeler_lanes minus_vd1_y = wrist_geo_g*s0;
    MODELER_PUT(1) = -minus_vd1_y;
    const modeler_lanes vd1_x = wrist_geo_g*c0;
    MODELER_PUT(2) = -vd1_x;
    /* link 2: angular velocity, w2 = R2' w1 + qd2 z */
    const modeler_lanes w2_x = s1*qd_0;
    const modeler_lanes w2_y = c1*qd_0;
    const modeler_lanes ww2_xy = w2_x*w2_y;
    MODELER_PUT(16) = -ww2_xy;
    /* link 2: acceleration of points of the link, U2 = [wd2 x] + [w2 x][w2 x] */
    const modeler_lanes minus_U2_yz = s1*qdd_0;
    const modeler_lanes ww2_yz = qd_1*w2_y;
    /* link 2: angular acceleration, wd2 = R2' wd1 + (R2' w1) x qd2 z + qdd2 z */
    const modeler_lanes wd2_x = minus_U2_yz + ww2_yz;
    const modeler_lanes ww2_xz = qd_1*w2_x;
    MODELER_PUT(3) = s1*wd2_x + c1*ww2_xz;
    const modeler_lanes ww2_zz = qd_1*qd_1;
    const modeler_lanes minus_U2_xx = w2_y*w2_y + ww2_zz;
    const modeler_lanes minus_U2_yy = w2_x*w2_x + ww2_zz;
    MODELER_PUT(17) = minus_U2_yy - minus_U2_xx;
    const modeler_lanes U2_xz = c1*qdd_0;
    const modeler_lanes wd2_y = U2_xz - ww2_xz;
    const modeler_lanes U2_zy = ww2_yz + wd2_x;
    MODELER_PUT(4) = c1*U2_zy - s1*(ww2_xz - wd2_y);
    MODELER_PUT(18) = minus_U2_yz;
    const modeler_lanes ww1_zz = qd_0*qd_0;
    MODELER_PUT(5) = s1*(qdd_1 + ww2_xy) - c1*(ww1_zz - minus_U2_xx);
    MODELER_PUT(19) = U2_xz;
    const modeler_lanes minus_U2_xy = qdd_1 - ww2_xy;
    MODELER_PUT(6) = s1*(ww1_zz - minus_U2_yy) + c1*minus_U2_xy;
    MODELER_PUT(20) = qdd_1;
    /* link 2: acceleration of the origin less gravity, vd2 = R2' (vd1 + U1 p2) */
    const modeler_lanes minus_vd2_y = s1*vd1_x;
    MODELER_PUT(21) = -minus_vd2_y;
    MODELER_PUT(7) = -c1*minus_vd1_y;
    const modeler_lanes vd2_x = c1*vd1_x;
    MODELER_PUT(22) = -vd2_x;
    MODELER_PUT(8) = s1*minus_vd1_y;
    /* link 3: angular velocity, w3 = R3' w2 + qd3 z */
    const modeler_lanes w3_x = c2*w2_x - s2*qd_1;
    const modeler_lanes minus_w3_y = c2*qd_1 + s2*w2_x;
    const modeler_lanes minus_ww3_xy = w3_x*minus_w3_y;
    MODELER_PUT(30) = minus_ww3_xy;
    /* link 3: angular acceleration, wd3 = R3' wd2 + (R3' w2) x qd3 z + qdd3 z */
    const modeler_lanes wd3_x = c2*wd2_x - s2*qdd_1 - qd_2*minus_w3_y;
    const modeler_lanes w3_z = qd_2 + w2_y;
    const modeler_lanes ww3_xz = w3_x*w3_z;
    const modeler_lanes t26 = c2*ww3_xz;
    MODELER_PUT(23) = -(s2*wd3_x + t26);
    /* link 3: axes of the joints below, for unit speed of each, e3 = R3' e2 */
    const modeler_lanes e3_1x = s1*c2;
    const modeler_lanes minus_e3_1y = s1*s2;
    const modeler_lanes t29 = ww3_xz*minus_e3_1y;
    MODELER_PUT(9) = wd3_x*e3_1x - t29 + c1*minus_ww3_xy;
    const modeler_lanes ww3_zz = w3_z*w3_z;
    /* link 3: acceleration of points of the link, U3 = [wd3 x] + [w3 x][w3 x] */
    const modeler_lanes minus_U3_xx = minus_w3_y*minus_w3_y + ww3_zz;
    const modeler_lanes minus_U3_yy = w3_x*w3_x + ww3_zz;
    /* link 3: moment on the link at its origin for one unit of a parameter, n3 = J3 wd3 + w3 x J3
        w3 + MS3 x vd3 */
    const modeler_lanes minus_n3_XYz = minus_U3_xx - minus_U3_yy;
    MODELER_PUT(31) = -minus_n3_XYz;
    const modeler_lanes minus_wd3_y = c2*qdd_1 + s2*wd2_x + qd_2*w3_x;
    const modeler_lanes U3_zx = minus_wd3_y + ww3_xz;
    const modeler_lanes minus_ww3_yz = minus_w3_y*w3_z;
    const modeler_lanes U3_zy = wd3_x - minus_ww3_yz;
    MODELER_PUT(24) = s2*U3_zx - c2*U3_zy;
    MODELER_PUT(10) = -(U3_zx*e3_1x + U3_zy*minus_e3_1y + c1*minus_n3_XYz);
    const modeler_lanes minus_U3_yz = wd3_x + minus_ww3_yz;
    MODELER_PUT(32) = minus_U3_yz;
    const modeler_lanes wd3_z = qdd_2 + wd2_y;
    const modeler_lanes U3_yx = wd3_z - minus_ww3_xy;
    const modeler_lanes minus_n3_XZy = minus_U2_yy - minus_U3_xx;
    MODELER_PUT(25) = c2*minus_n3_XZy - s2*U3_yx;
    MODELER_PUT(11) = U3_yx*e3_1x + minus_e3_1y*minus_n3_XZy + c1*minus_U3_yz;
    const modeler_lanes minus_U3_xz = minus_wd3_y - ww3_xz;
    MODELER_PUT(33) = -minus_U3_xz;
    const modeler_lanes n3_YZx = minus_U2_yy - minus_U3_yy;
    const modeler_lanes minus_U3_xy = wd3_z + minus_ww3_xy;
    MODELER_PUT(26) = -(s2*n3_YZx + c2*minus_U3_xy);
    MODELER_PUT(12) = e3_1x*n3_YZx - minus_U3_xy*minus_e3_1y - c1*minus_U3_xz;
    MODELER_PUT(34) = wd3_z;
    MODELER_PUT(27) = t26 + s2*minus_ww3_yz;
    MODELER_PUT(13) = t29 - minus_ww3_yz*e3_1x + c1*wd3_z;
    /* link 3: acceleration of the origin less gravity, vd3 = R3' (vd2 + U2 p3) */
    const modeler_lanes vd3a_z = minus_vd1_y + wrist_geo_bl1*U2_zy;
    const modeler_lanes vd3a_x = vd2_x - wrist_geo_bl1*minus_U2_xy;
    const modeler_lanes minus_vd3_y = c2*vd3a_z + s2*vd3a_x;
    MODELER_PUT(35) = -minus_vd3_y;
    const modeler_lanes minus_vd3_z = minus_vd2_y + wrist_geo_bl1*minus_U2_yy;
    /* link 3: velocity of the origin, for unit speed of each joint below, m3 = R3' (m2 + e2 x p3)
        */
    const modeler_lanes minus_m3_2x = wrist_geo_bl1*c2;
    const modeler_lanes m3_2y = wrist_geo_bl1*s2;
    MODELER_PUT(28) = minus_U3_xx*minus_m3_2x + U3_yx*m3_2y - c2*minus_vd3_z;
    const modeler_lanes t51 = wrist_geo_bl1*s1;
    const modeler_lanes minus_m3_1x = s2*t51;
    const modeler_lanes minus_m3_1y = c2*t51;
    MODELER_PUT(14) = minus_U3_xx*minus_m3_1x - U3_yx*minus_m3_1y - (minus_vd3_z*minus_e3_1y +
        c1*minus_vd3_y);
    const modeler_lanes vd3_x = c2*vd3a_x - s2*vd3a_z;
    MODELER_PUT(36) = -vd3_x;
    MODELER_PUT(29) = minus_U3_xy*minus_m3_2x - minus_U3_yy*m3_2y + s2*minus_vd3_z;
    MODELER_PUT(15) = minus_U3_xy*minus_m3_1x + minus_U3_yy*minus_m3_1y - (minus_vd3_z*e3_1x +
        c1*vd3_x);
}

MODELER_TARGET static void MODELER_VERSION(tile)(const double *q, const double *qd,
                                                 const double *qdd, const double *s, double *values)
{
    for (int lane = 0; lane < MODELER_LANES; lane += MODELER_WIDTH) {
        MODELER_VERSION(entries)(q, qd, qdd, s, values + lane);
        q += 3*MODELER_WIDTH;
        qd += 3*MODELER_WIDTH;
        qdd += 3*MODELER_WIDTH;
    }
}

#endif
