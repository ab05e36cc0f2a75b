/* 3R industrial wrist (Hanssen, Hovland, Brogardh)
 *
 * Functions of wrist_tile.h.
 * This file includes itself once for every instruction set.
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
    {3, 17, 0, 37, row, column, tile_##version}

static const modeler_tiled tiled[] = {MODELER_EACH_VERSION(TILED)};

const modeler_tiled *wrist_tiled(void)
{
    return &tiled[MODELER_BEST_VERSION];
}

const char *wrist_tile_signature(void)
{
    return "c67e08e798fc0aab";
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
    const modeler_lanes t1 = wrist_geo_g*s0;
    MODELER_PUT(1) = -t1;
    const modeler_lanes t2 = wrist_geo_g*c0;
    MODELER_PUT(2) = -t2;
    const modeler_lanes t3 = s1*qd_0;
    const modeler_lanes t4 = c1*qd_0;
    const modeler_lanes t5 = t3*t4;
    MODELER_PUT(16) = -t5;
    const modeler_lanes t6 = s1*qdd_0;
    const modeler_lanes t7 = qd_1*t4;
    const modeler_lanes t8 = t6 + t7;
    const modeler_lanes t9 = qd_1*t3;
    MODELER_PUT(3) = s1*t8 + c1*t9;
    const modeler_lanes t10 = qd_1*qd_1;
    const modeler_lanes t11 = t4*t4 + t10;
    const modeler_lanes t12 = t3*t3 + t10;
    MODELER_PUT(17) = t12 - t11;
    const modeler_lanes t13 = c1*qdd_0;
    const modeler_lanes t14 = t13 - t9;
    const modeler_lanes t15 = t7 + t8;
    MODELER_PUT(4) = c1*t15 - s1*(t9 - t14);
    MODELER_PUT(18) = t6;
    const modeler_lanes t16 = qd_0*qd_0;
    MODELER_PUT(5) = s1*(qdd_1 + t5) - c1*(t16 - t11);
    MODELER_PUT(19) = t13;
    const modeler_lanes t17 = qdd_1 - t5;
    MODELER_PUT(6) = s1*(t16 - t12) + c1*t17;
    MODELER_PUT(20) = qdd_1;
    const modeler_lanes t18 = s1*t2;
    MODELER_PUT(21) = -t18;
    MODELER_PUT(7) = -c1*t1;
    const modeler_lanes t19 = c1*t2;
    MODELER_PUT(22) = -t19;
    MODELER_PUT(8) = s1*t1;
    const modeler_lanes t20 = c2*t3 - s2*qd_1;
    const modeler_lanes t21 = c2*qd_1 + s2*t3;
    const modeler_lanes t22 = t20*t21;
    MODELER_PUT(30) = t22;
    const modeler_lanes t23 = c2*t8 - s2*qdd_1 - qd_2*t21;
    const modeler_lanes t24 = qd_2 + t4;
    const modeler_lanes t25 = t20*t24;
    const modeler_lanes t26 = c2*t25;
    MODELER_PUT(23) = -(s2*t23 + t26);
    const modeler_lanes t27 = s1*c2;
    const modeler_lanes t28 = s1*s2;
    const modeler_lanes t29 = t25*t28;
    MODELER_PUT(9) = t23*t27 - t29 + c1*t22;
    const modeler_lanes t30 = t24*t24;
    const modeler_lanes t31 = t21*t21 + t30;
    const modeler_lanes t32 = t20*t20 + t30;
    const modeler_lanes t33 = t31 - t32;
    MODELER_PUT(31) = -t33;
    const modeler_lanes t34 = c2*qdd_1 + s2*t8 + qd_2*t20;
    const modeler_lanes t35 = t34 + t25;
    const modeler_lanes t36 = t21*t24;
    const modeler_lanes t37 = t23 - t36;
    MODELER_PUT(24) = s2*t35 - c2*t37;
    MODELER_PUT(10) = -(t35*t27 + t37*t28 + c1*t33);
    const modeler_lanes t38 = t23 + t36;
    MODELER_PUT(32) = t38;
    const modeler_lanes t39 = qdd_2 + t14;
    const modeler_lanes t40 = t39 - t22;
    const modeler_lanes t41 = t12 - t31;
    MODELER_PUT(25) = c2*t41 - s2*t40;
    MODELER_PUT(11) = t40*t27 + t28*t41 + c1*t38;
    const modeler_lanes t42 = t34 - t25;
    MODELER_PUT(33) = -t42;
    const modeler_lanes t43 = t12 - t32;
    const modeler_lanes t44 = t39 + t22;
    MODELER_PUT(26) = -(s2*t43 + c2*t44);
    MODELER_PUT(12) = t27*t43 - t44*t28 - c1*t42;
    MODELER_PUT(34) = t39;
    MODELER_PUT(27) = t26 + s2*t36;
    MODELER_PUT(13) = t29 - t36*t27 + c1*t39;
    const modeler_lanes t45 = t1 + wrist_geo_bl1*t15;
    const modeler_lanes t46 = t19 - wrist_geo_bl1*t17;
    const modeler_lanes t47 = c2*t45 + s2*t46;
    MODELER_PUT(35) = -t47;
    const modeler_lanes t48 = t18 + wrist_geo_bl1*t12;
    const modeler_lanes t49 = wrist_geo_bl1*c2;
    const modeler_lanes t50 = wrist_geo_bl1*s2;
    MODELER_PUT(28) = t31*t49 + t40*t50 - c2*t48;
    const modeler_lanes t51 = wrist_geo_bl1*s1;
    const modeler_lanes t52 = s2*t51;
    const modeler_lanes t53 = c2*t51;
    MODELER_PUT(14) = t31*t52 - t40*t53 - (t48*t28 + c1*t47);
    const modeler_lanes t54 = c2*t46 - s2*t45;
    MODELER_PUT(36) = -t54;
    MODELER_PUT(29) = t44*t49 - t32*t50 + s2*t48;
    MODELER_PUT(15) = t44*t52 + t32*t53 - (t48*t27 + c1*t54);
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
