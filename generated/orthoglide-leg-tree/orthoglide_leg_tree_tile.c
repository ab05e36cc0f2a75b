/* One leg of the Orthoglide, cut open
 *
 * Functions of orthoglide_leg_tree_tile.h.
 * This file includes itself once for every instruction set.
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
    {6, 32, 0, 88, row, column, tile_##version}

static const modeler_tiled tiled[] = {MODELER_EACH_VERSION(TILED)};

const modeler_tiled *orthoglide_leg_tree_tiled(void)
{
    return &tiled[MODELER_BEST_VERSION];
}

const char *orthoglide_leg_tree_tile_signature(void)
{
    return "013bd860370eec91";
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
    const modeler_lanes t1 = c1*qdd_0;
    MODELER_PUT(12) = -t1;
    const modeler_lanes t2 = qd_1*qd_1;
    MODELER_PUT(1) = s1*t2 - c1*qdd_1;
    const modeler_lanes t3 = s1*qdd_0;
    MODELER_PUT(13) = t3;
    MODELER_PUT(2) = s1*qdd_1 + c1*t2;
    const modeler_lanes t4 = s2*qd_1;
    const modeler_lanes t5 = c2*qd_1;
    const modeler_lanes t6 = t4*t5;
    MODELER_PUT(39) = -t6;
    const modeler_lanes t7 = s2*qdd_1;
    const modeler_lanes t8 = qd_2*t5;
    const modeler_lanes t9 = t7 + t8;
    const modeler_lanes t10 = qd_2*t4;
    MODELER_PUT(14) = s2*t9 + c2*t10;
    const modeler_lanes t11 = qd_2*qd_2;
    const modeler_lanes t12 = t5*t5 + t11;
    const modeler_lanes t13 = t4*t4 + t11;
    MODELER_PUT(40) = t13 - t12;
    const modeler_lanes t14 = c2*qdd_1;
    const modeler_lanes t15 = t14 - t10;
    const modeler_lanes t16 = t10 - t15;
    const modeler_lanes t17 = t8 + t9;
    MODELER_PUT(15) = c2*t17 - s2*t16;
    MODELER_PUT(41) = -t7;
    const modeler_lanes t18 = qdd_2 + t6;
    MODELER_PUT(16) = c2*(t2 - t12) - s2*t18;
    MODELER_PUT(42) = -t14;
    const modeler_lanes t19 = qdd_2 - t6;
    MODELER_PUT(17) = -(s2*(t2 - t13) + c2*t19);
    MODELER_PUT(43) = qdd_2;
    const modeler_lanes t20 = orthoglide_leg_tree_geo_g*c2 + s2*t3;
    MODELER_PUT(44) = t20;
    MODELER_PUT(18) = -c2*t1;
    const modeler_lanes t21 = s1*c2;
    const modeler_lanes t22 = s1*s2;
    MODELER_PUT(3) = t12*t21 + t18*t22 + c1*t16;
    const modeler_lanes t23 = c2*t3 - orthoglide_leg_tree_geo_g*s2;
    MODELER_PUT(45) = t23;
    MODELER_PUT(19) = s2*t1;
    MODELER_PUT(4) = t19*t21 - t13*t22 + c1*t17;
    const modeler_lanes t24 = c3*t4 + s3*t5;
    const modeler_lanes t25 = c3*t5 - s3*t4;
    const modeler_lanes t26 = t24*t25;
    MODELER_PUT(60) = -t26;
    MODELER_PUT(46) = -t26;
    const modeler_lanes t27 = c3*t9 + s3*t15 + qd_3*t25;
    const modeler_lanes t28 = s2*c3 + c2*s3;
    const modeler_lanes t29 = qd_2 + qd_3;
    const modeler_lanes t30 = t24*t29;
    const modeler_lanes t31 = c2*c3 - s2*s3;
    MODELER_PUT(20) = t27*t28 + t30*t31;
    const modeler_lanes t32 = t29*t29;
    const modeler_lanes t33 = t25*t25 + t32;
    const modeler_lanes t34 = t24*t24 + t32;
    const modeler_lanes t35 = t33 - t34;
    MODELER_PUT(61) = -t35;
    MODELER_PUT(47) = -t35;
    const modeler_lanes t36 = c3*t15 - s3*t9 - qd_3*t24;
    const modeler_lanes t37 = t36 - t30;
    const modeler_lanes t38 = t25*t29;
    const modeler_lanes t39 = t27 + t38;
    MODELER_PUT(21) = t37*t28 + t39*t31;
    const modeler_lanes t40 = t27 - t38;
    MODELER_PUT(62) = -t40;
    MODELER_PUT(48) = -t40;
    const modeler_lanes t41 = qdd_2 + qdd_3;
    const modeler_lanes t42 = t41 + t26;
    MODELER_PUT(22) = t31*(t2 - t33) - t42*t28;
    const modeler_lanes t43 = t36 + t30;
    MODELER_PUT(63) = -t43;
    MODELER_PUT(49) = -t43;
    const modeler_lanes t44 = t41 - t26;
    MODELER_PUT(23) = -(t28*(t2 - t34) + t44*t31);
    MODELER_PUT(64) = t41;
    MODELER_PUT(50) = t41;
    const modeler_lanes t45 = t20 + orthoglide_leg_tree_geo_D4*t18;
    const modeler_lanes t46 = t23 + orthoglide_leg_tree_geo_D4*t12;
    const modeler_lanes t47 = c3*t45 + s3*t46;
    MODELER_PUT(65) = t47;
    const modeler_lanes t48 = orthoglide_leg_tree_geo_D4*s3;
    const modeler_lanes t49 = orthoglide_leg_tree_geo_D4*c3;
    MODELER_PUT(51) = t42*t49 - t33*t48 + t47;
    const modeler_lanes t50 = t1 + orthoglide_leg_tree_geo_D4*t16;
    const modeler_lanes t51 = orthoglide_leg_tree_geo_D4*c2;
    MODELER_PUT(24) = t37*t51 - t50*t31;
    const modeler_lanes t52 = c3*t21 - s3*t22;
    const modeler_lanes t53 = c3*t22 + s3*t21;
    MODELER_PUT(5) = t33*t52 + t42*t53 - c1*t37;
    const modeler_lanes t54 = c3*t46 - s3*t45;
    MODELER_PUT(66) = t54;
    MODELER_PUT(52) = t54 - (t44*t48 + t34*t49);
    MODELER_PUT(25) = t50*t28 - t39*t51;
    MODELER_PUT(6) = t44*t52 - t34*t53 + c1*t39;
    const modeler_lanes t55 = c4*t24 - s4*t29;
    const modeler_lanes t56 = c4*t29 + s4*t24;
    const modeler_lanes t57 = t55*t56;
    MODELER_PUT(74) = t57;
    const modeler_lanes t58 = c4*t27 - s4*t41 - qd_4*t56;
    const modeler_lanes t59 = qd_4 + t25;
    const modeler_lanes t60 = t55*t59;
    const modeler_lanes t61 = c4*t60;
    const modeler_lanes t62 = s4*t58 + t61;
    MODELER_PUT(67) = -t62;
    MODELER_PUT(53) = -t62;
    const modeler_lanes t63 = c4*t28;
    const modeler_lanes t64 = s4*t28;
    const modeler_lanes t65 = t60*t64;
    MODELER_PUT(26) = t58*t63 - t65 + t57*t31;
    const modeler_lanes t66 = t59*t59;
    const modeler_lanes t67 = t56*t56 + t66;
    const modeler_lanes t68 = t55*t55 + t66;
    const modeler_lanes t69 = t67 - t68;
    MODELER_PUT(75) = -t69;
    const modeler_lanes t70 = c4*t41 + s4*t27 + qd_4*t55;
    const modeler_lanes t71 = t70 + t60;
    const modeler_lanes t72 = t56*t59;
    const modeler_lanes t73 = t58 - t72;
    const modeler_lanes t74 = s4*t71 - c4*t73;
    MODELER_PUT(68) = t74;
    MODELER_PUT(54) = t74;
    MODELER_PUT(27) = -(t71*t63 + t73*t64 + t31*t69);
    const modeler_lanes t75 = t58 + t72;
    MODELER_PUT(76) = -t75;
    const modeler_lanes t76 = qdd_4 + t36;
    const modeler_lanes t77 = t76 - t57;
    const modeler_lanes t78 = t34 - t67;
    const modeler_lanes t79 = s4*t77 - c4*t78;
    MODELER_PUT(69) = t79;
    MODELER_PUT(55) = t79;
    MODELER_PUT(28) = -(t77*t63 + t64*t78 + t75*t31);
    const modeler_lanes t80 = t70 - t60;
    MODELER_PUT(77) = t80;
    const modeler_lanes t81 = t34 - t68;
    const modeler_lanes t82 = t76 + t57;
    const modeler_lanes t83 = s4*t81 + c4*t82;
    MODELER_PUT(70) = t83;
    MODELER_PUT(56) = t83;
    MODELER_PUT(29) = t80*t31 - (t63*t81 - t82*t64);
    MODELER_PUT(78) = t76;
    const modeler_lanes t84 = t61 + s4*t72;
    MODELER_PUT(71) = t84;
    MODELER_PUT(57) = t84;
    MODELER_PUT(30) = t65 - t72*t63 + t76*t31;
    const modeler_lanes t85 = c4*t50 - s4*t54;
    MODELER_PUT(79) = -t85;
    const modeler_lanes t86 = c4*t47;
    MODELER_PUT(72) = t86;
    const modeler_lanes t87 = c4*t48;
    const modeler_lanes t88 = s4*t48;
    MODELER_PUT(58) = t71*t49 - (t67*t87 + t77*t88) + t86;
    const modeler_lanes t89 = s4*t51;
    const modeler_lanes t90 = c4*t51;
    MODELER_PUT(31) = t47*t64 - t85*t31 + (t77*t90 - t67*t89);
    const modeler_lanes t91 = c4*t52 + c1*s4;
    const modeler_lanes t92 = c1*c4 - s4*t52;
    MODELER_PUT(7) = t67*t91 - t77*t92 + t71*t53;
    const modeler_lanes t93 = c4*t54 + s4*t50;
    MODELER_PUT(80) = t93;
    const modeler_lanes t94 = s4*t47;
    MODELER_PUT(73) = -t94;
    MODELER_PUT(59) = -(t82*t87 - t68*t88 - t73*t49 + t94);
    MODELER_PUT(32) = t47*t63 + t93*t31 - (t82*t89 + t68*t90);
    MODELER_PUT(8) = t82*t91 + t68*t92 + t73*t53;
    const modeler_lanes t95 = s5*qd_1;
    const modeler_lanes t96 = c5*qd_1;
    const modeler_lanes t97 = t95*t96;
    MODELER_PUT(81) = -t97;
    const modeler_lanes t98 = s5*qdd_1;
    const modeler_lanes t99 = qd_5*t96;
    const modeler_lanes t100 = t98 + t99;
    const modeler_lanes t101 = qd_5*t95;
    MODELER_PUT(33) = s5*t100 + c5*t101;
    const modeler_lanes t102 = qd_5*qd_5;
    const modeler_lanes t103 = t96*t96 + t102;
    const modeler_lanes t104 = t95*t95 + t102;
    MODELER_PUT(82) = t104 - t103;
    const modeler_lanes t105 = c5*qdd_1;
    const modeler_lanes t106 = t101 - t105 + t101;
    const modeler_lanes t107 = t99 + t100;
    MODELER_PUT(34) = c5*t107 - s5*t106;
    MODELER_PUT(83) = -t98;
    const modeler_lanes t108 = qdd_5 + t97;
    MODELER_PUT(35) = c5*(t2 - t103) - s5*t108;
    MODELER_PUT(84) = -t105;
    const modeler_lanes t109 = qdd_5 - t97;
    MODELER_PUT(36) = -(s5*(t2 - t104) + c5*t109);
    MODELER_PUT(85) = qdd_5;
    MODELER_PUT(86) = orthoglide_leg_tree_geo_g*c5 + s5*t3;
    MODELER_PUT(37) = -c5*t1;
    const modeler_lanes t110 = s1*c5;
    const modeler_lanes t111 = s1*s5;
    MODELER_PUT(9) = t103*t110 + t108*t111 + c1*t106;
    MODELER_PUT(87) = c5*t3 - orthoglide_leg_tree_geo_g*s5;
    MODELER_PUT(38) = s5*t1;
    MODELER_PUT(10) = t109*t110 - t104*t111 + c1*t107;
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
