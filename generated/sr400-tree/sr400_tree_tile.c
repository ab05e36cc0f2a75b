/* SR400, 6R arm with a parallelogram, cut open
 *
 * Functions of sr400_tree_tile.h.
 * This file includes itself once for every instruction set.
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
    {8, 50, 0, 172, row, column, tile_##version}

static const modeler_tiled tiled[] = {MODELER_EACH_VERSION(TILED)};

const modeler_tiled *sr400_tree_tiled(void)
{
    return &tiled[MODELER_BEST_VERSION];
}

const char *sr400_tree_tile_signature(void)
{
    return "bdce896f9c70e246";
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
    const modeler_lanes t1 = s1*qd_0;
    const modeler_lanes t2 = c1*qd_0;
    const modeler_lanes t3 = t1*t2;
    MODELER_PUT(46) = -t3;
    const modeler_lanes t4 = s1*qdd_0;
    const modeler_lanes t5 = qd_1*t2;
    const modeler_lanes t6 = t4 + t5;
    const modeler_lanes t7 = qd_1*t1;
    MODELER_PUT(1) = s1*t6 + c1*t7;
    const modeler_lanes t8 = qd_1*qd_1;
    const modeler_lanes t9 = t2*t2 + t8;
    const modeler_lanes t10 = t1*t1 + t8;
    MODELER_PUT(47) = t10 - t9;
    const modeler_lanes t11 = c1*qdd_0;
    const modeler_lanes t12 = t11 - t7;
    const modeler_lanes t13 = t7 - t12;
    const modeler_lanes t14 = t5 + t6;
    MODELER_PUT(2) = c1*t14 - s1*t13;
    MODELER_PUT(48) = -t4;
    const modeler_lanes t15 = qdd_1 + t3;
    const modeler_lanes t16 = qd_0*qd_0;
    MODELER_PUT(3) = c1*(t16 - t9) - s1*t15;
    MODELER_PUT(49) = -t11;
    MODELER_PUT(4) = -(s1*(t16 - t10) + c1*(qdd_1 - t3));
    MODELER_PUT(50) = qdd_1;
    const modeler_lanes t17 = sr400_tree_geo_D2*t16;
    const modeler_lanes t18 = sr400_tree_geo_g*c1 - s1*t17;
    MODELER_PUT(51) = -t18;
    const modeler_lanes t19 = sr400_tree_geo_D2*qdd_0;
    MODELER_PUT(5) = c1*t19 - sr400_tree_geo_D2*t13;
    const modeler_lanes t20 = c1*t17 + sr400_tree_geo_g*s1;
    MODELER_PUT(52) = t20;
    MODELER_PUT(6) = -(s1*t19 + sr400_tree_geo_D2*t14);
    const modeler_lanes t21 = c2*t1 + s2*t2;
    const modeler_lanes t22 = c2*t2 - s2*t1;
    const modeler_lanes t23 = t21*t22;
    MODELER_PUT(81) = -t23;
    MODELER_PUT(53) = -t23;
    const modeler_lanes t24 = c2*t6 + s2*t12 + qd_2*t22;
    const modeler_lanes t25 = s1*c2 + c1*s2;
    const modeler_lanes t26 = qd_1 + qd_2;
    const modeler_lanes t27 = t21*t26;
    const modeler_lanes t28 = c1*c2 - s1*s2;
    MODELER_PUT(7) = t24*t25 + t27*t28;
    const modeler_lanes t29 = t26*t26;
    const modeler_lanes t30 = t22*t22 + t29;
    const modeler_lanes t31 = t21*t21 + t29;
    const modeler_lanes t32 = t30 - t31;
    MODELER_PUT(82) = -t32;
    MODELER_PUT(54) = -t32;
    const modeler_lanes t33 = c2*t12 - s2*t6 - qd_2*t21;
    const modeler_lanes t34 = t33 - t27;
    const modeler_lanes t35 = t22*t26;
    const modeler_lanes t36 = t24 + t35;
    MODELER_PUT(8) = t34*t25 + t36*t28;
    const modeler_lanes t37 = t24 - t35;
    MODELER_PUT(83) = -t37;
    MODELER_PUT(55) = -t37;
    const modeler_lanes t38 = qdd_1 + qdd_2;
    const modeler_lanes t39 = t38 + t23;
    MODELER_PUT(9) = t28*(t16 - t30) - t39*t25;
    const modeler_lanes t40 = t33 + t27;
    MODELER_PUT(84) = -t40;
    MODELER_PUT(56) = -t40;
    const modeler_lanes t41 = t38 - t23;
    MODELER_PUT(10) = -(t25*(t16 - t31) + t41*t28);
    MODELER_PUT(85) = t38;
    MODELER_PUT(57) = t38;
    const modeler_lanes t42 = t18 - sr400_tree_geo_D3*t15;
    const modeler_lanes t43 = t20 + sr400_tree_geo_D3*t9;
    const modeler_lanes t44 = c2*t42 - s2*t43;
    MODELER_PUT(86) = -t44;
    const modeler_lanes t45 = sr400_tree_geo_D3*s2;
    const modeler_lanes t46 = sr400_tree_geo_D3*c2;
    MODELER_PUT(58) = -(t30*t45 - t39*t46 + t44);
    const modeler_lanes t47 = t19 - sr400_tree_geo_D3*t13;
    const modeler_lanes t48 = sr400_tree_geo_D2 + sr400_tree_geo_D3*c1;
    MODELER_PUT(11) = t47*t28 + t34*t48;
    const modeler_lanes t49 = c2*t43 + s2*t42;
    MODELER_PUT(87) = t49;
    MODELER_PUT(59) = t49 - (t41*t45 + t31*t46);
    MODELER_PUT(12) = -(t47*t25 + t36*t48);
    const modeler_lanes t50 = c3*t21 + s3*t26;
    const modeler_lanes t51 = c3*t26 - s3*t21;
    const modeler_lanes t52 = t50*t51;
    MODELER_PUT(109) = -t52;
    const modeler_lanes t53 = c3*t24 + s3*t38 + qd_3*t51;
    const modeler_lanes t54 = qd_3 - t22;
    const modeler_lanes t55 = t50*t54;
    const modeler_lanes t56 = c3*t55;
    const modeler_lanes t57 = s3*t53 + t56;
    MODELER_PUT(88) = t57;
    MODELER_PUT(60) = t57;
    const modeler_lanes t58 = c3*t25;
    const modeler_lanes t59 = s3*t25;
    const modeler_lanes t60 = t55*t59;
    MODELER_PUT(13) = t53*t58 - t60 + t52*t28;
    const modeler_lanes t61 = t54*t54;
    const modeler_lanes t62 = t51*t51 + t61;
    const modeler_lanes t63 = t50*t50 + t61;
    const modeler_lanes t64 = t62 - t63;
    MODELER_PUT(110) = -t64;
    const modeler_lanes t65 = c3*t38 - s3*t24 - qd_3*t50;
    const modeler_lanes t66 = t65 - t55;
    const modeler_lanes t67 = t51*t54;
    const modeler_lanes t68 = t53 + t67;
    const modeler_lanes t69 = s3*t66 + c3*t68;
    MODELER_PUT(89) = t69;
    MODELER_PUT(61) = t69;
    MODELER_PUT(14) = t66*t58 - t68*t59 + t28*t64;
    const modeler_lanes t70 = t53 - t67;
    MODELER_PUT(111) = -t70;
    const modeler_lanes t71 = qdd_3 - t33;
    const modeler_lanes t72 = t71 + t52;
    const modeler_lanes t73 = t31 - t62;
    const modeler_lanes t74 = s3*t72 - c3*t73;
    MODELER_PUT(90) = -t74;
    MODELER_PUT(62) = -t74;
    MODELER_PUT(15) = t70*t28 - (t72*t58 + t59*t73);
    const modeler_lanes t75 = t65 + t55;
    MODELER_PUT(112) = -t75;
    const modeler_lanes t76 = t31 - t63;
    const modeler_lanes t77 = t71 - t52;
    const modeler_lanes t78 = s3*t76 + c3*t77;
    MODELER_PUT(91) = -t78;
    MODELER_PUT(63) = -t78;
    MODELER_PUT(16) = t75*t28 - (t58*t76 - t77*t59);
    MODELER_PUT(113) = t71;
    const modeler_lanes t79 = t56 - s3*t67;
    MODELER_PUT(92) = -t79;
    MODELER_PUT(64) = -t79;
    MODELER_PUT(17) = t60 + t67*t58 - t71*t28;
    const modeler_lanes t80 = sr400_tree_geo_D4*t34 - sr400_tree_geo_RL4*t36 + t47;
    const modeler_lanes t81 = sr400_tree_geo_D4*t30 + sr400_tree_geo_RL4*t41 + t49;
    const modeler_lanes t82 = c3*t80 - s3*t81;
    MODELER_PUT(114) = -t82;
    const modeler_lanes t83 = sr400_tree_geo_RL4*t31 - sr400_tree_geo_D4*t39 + t44;
    const modeler_lanes t84 = c3*t83;
    const modeler_lanes t85 = sr400_tree_geo_RL4*c3;
    const modeler_lanes t86 = sr400_tree_geo_RL4*s3;
    MODELER_PUT(93) = t62*t85 + t72*t86 + sr400_tree_geo_D4*t66 - t84;
    const modeler_lanes t87 = sr400_tree_geo_RL4 - t45;
    const modeler_lanes t88 = c3*t87;
    const modeler_lanes t89 = s3*t87;
    const modeler_lanes t90 = sr400_tree_geo_D4 + t46;
    MODELER_PUT(65) = t62*t88 + t72*t89 + t66*t90 - t84;
    const modeler_lanes t91 = sr400_tree_geo_D4*t28 - sr400_tree_geo_RL4*t25 + t48;
    const modeler_lanes t92 = s3*t91;
    const modeler_lanes t93 = c3*t91;
    MODELER_PUT(18) = t83*t59 + t82*t28 + (t62*t92 - t72*t93);
    const modeler_lanes t94 = c3*t81 + s3*t80;
    MODELER_PUT(115) = t94;
    const modeler_lanes t95 = s3*t83;
    MODELER_PUT(94) = t77*t85 - t63*t86 - sr400_tree_geo_D4*t68 + t95;
    MODELER_PUT(66) = t77*t88 - t63*t89 - t68*t90 + t95;
    MODELER_PUT(19) = t83*t58 - t94*t28 + (t77*t92 + t63*t93);
    const modeler_lanes t96 = c4*t50 - s4*t54;
    const modeler_lanes t97 = c4*t54 + s4*t50;
    const modeler_lanes t98 = t96*t97;
    MODELER_PUT(130) = t98;
    const modeler_lanes t99 = c4*t53 - s4*t71 - qd_4*t97;
    const modeler_lanes t100 = qd_4 + t51;
    const modeler_lanes t101 = t96*t100;
    const modeler_lanes t102 = c4*t101;
    MODELER_PUT(116) = -(s4*t99 + t102);
    const modeler_lanes t103 = s3*c4;
    const modeler_lanes t104 = s3*s4;
    const modeler_lanes t105 = t101*t104;
    const modeler_lanes t106 = t99*t103 - t105 + c3*t98;
    MODELER_PUT(95) = t106;
    MODELER_PUT(67) = t106;
    const modeler_lanes t107 = c4*t58 + s4*t28;
    const modeler_lanes t108 = c4*t28 - s4*t58;
    const modeler_lanes t109 = t101*t108;
    MODELER_PUT(20) = t99*t107 + t109 - t98*t59;
    const modeler_lanes t110 = t100*t100;
    const modeler_lanes t111 = t97*t97 + t110;
    const modeler_lanes t112 = t96*t96 + t110;
    const modeler_lanes t113 = t111 - t112;
    MODELER_PUT(131) = -t113;
    const modeler_lanes t114 = c4*t71 + s4*t53 + qd_4*t96;
    const modeler_lanes t115 = t114 + t101;
    const modeler_lanes t116 = t97*t100;
    const modeler_lanes t117 = t99 - t116;
    MODELER_PUT(117) = s4*t115 - c4*t117;
    const modeler_lanes t118 = t115*t103 + t117*t104 + c3*t113;
    MODELER_PUT(96) = -t118;
    MODELER_PUT(68) = -t118;
    MODELER_PUT(21) = t59*t113 - (t115*t107 - t117*t108);
    const modeler_lanes t119 = t99 + t116;
    MODELER_PUT(132) = -t119;
    const modeler_lanes t120 = qdd_4 + t65;
    const modeler_lanes t121 = t120 - t98;
    const modeler_lanes t122 = t63 - t111;
    MODELER_PUT(118) = s4*t121 - c4*t122;
    const modeler_lanes t123 = t121*t103 + t104*t122 + c3*t119;
    MODELER_PUT(97) = -t123;
    MODELER_PUT(69) = -t123;
    MODELER_PUT(22) = t119*t59 - (t121*t107 - t108*t122);
    const modeler_lanes t124 = t114 - t101;
    MODELER_PUT(133) = t124;
    const modeler_lanes t125 = t63 - t112;
    const modeler_lanes t126 = t120 + t98;
    MODELER_PUT(119) = s4*t125 + c4*t126;
    const modeler_lanes t127 = t103*t125 - t126*t104 - c3*t124;
    MODELER_PUT(98) = -t127;
    MODELER_PUT(70) = -t127;
    MODELER_PUT(23) = -(t107*t125 + t126*t108 + t124*t59);
    MODELER_PUT(134) = t120;
    MODELER_PUT(120) = t102 + s4*t116;
    const modeler_lanes t128 = t105 - t116*t103 + c3*t120;
    MODELER_PUT(99) = t128;
    MODELER_PUT(71) = t128;
    MODELER_PUT(24) = -(t109 + t116*t107 + t120*t59);
    const modeler_lanes t129 = c4*t83 - s4*t94;
    MODELER_PUT(135) = -t129;
    MODELER_PUT(121) = -c4*t82;
    const modeler_lanes t130 = t82*t104 + c3*t129;
    const modeler_lanes t131 = c4*t85 - sr400_tree_geo_D4*s4;
    const modeler_lanes t132 = sr400_tree_geo_D4*c4 + s4*t85;
    MODELER_PUT(100) = t111*t131 + t121*t132 + t115*t86 - t130;
    const modeler_lanes t133 = c4*t88 - s4*t90;
    const modeler_lanes t134 = c4*t90 + s4*t88;
    MODELER_PUT(72) = t111*t133 + t121*t134 + t115*t89 - t130;
    const modeler_lanes t135 = c4*t92;
    const modeler_lanes t136 = s4*t92;
    MODELER_PUT(25) = t82*t108 + t129*t59 + (t111*t135 + t121*t136 - t115*t93);
    const modeler_lanes t137 = c4*t94 + s4*t83;
    MODELER_PUT(136) = t137;
    MODELER_PUT(122) = s4*t82;
    const modeler_lanes t138 = t82*t103 - c3*t137;
    MODELER_PUT(101) = t126*t131 - t112*t132 + t117*t86 - t138;
    MODELER_PUT(73) = t126*t133 - t112*t134 + t117*t89 - t138;
    MODELER_PUT(26) = t126*t135 - t112*t136 - t117*t93 - (t82*t107 + t137*t59);
    const modeler_lanes t139 = c5*t96 + s5*t100;
    const modeler_lanes t140 = c5*t100 - s5*t96;
    const modeler_lanes t141 = t139*t140;
    MODELER_PUT(144) = -t141;
    const modeler_lanes t142 = c5*t99 + s5*t120 + qd_5*t140;
    const modeler_lanes t143 = qd_5 + t97;
    const modeler_lanes t144 = t139*t143;
    const modeler_lanes t145 = c5*t144;
    MODELER_PUT(137) = s5*t142 + t145;
    const modeler_lanes t146 = s4*c5;
    const modeler_lanes t147 = s4*s5;
    const modeler_lanes t148 = t144*t147;
    MODELER_PUT(123) = -(t142*t146 - t148 + c4*t141);
    const modeler_lanes t149 = c5*t103 + c3*s5;
    const modeler_lanes t150 = c3*c5 - s5*t103;
    const modeler_lanes t151 = t144*t150;
    const modeler_lanes t152 = t142*t149 + t151 - t141*t104;
    MODELER_PUT(102) = t152;
    MODELER_PUT(74) = t152;
    const modeler_lanes t153 = c5*t107 - s5*t59;
    const modeler_lanes t154 = c5*t59 + s5*t107;
    const modeler_lanes t155 = t144*t154;
    MODELER_PUT(27) = t142*t153 - t155 + t141*t108;
    const modeler_lanes t156 = t143*t143;
    const modeler_lanes t157 = t140*t140 + t156;
    const modeler_lanes t158 = t139*t139 + t156;
    const modeler_lanes t159 = t157 - t158;
    MODELER_PUT(145) = -t159;
    const modeler_lanes t160 = c5*t120 - s5*t99 - qd_5*t139;
    const modeler_lanes t161 = t160 - t144;
    const modeler_lanes t162 = t140*t143;
    const modeler_lanes t163 = t142 + t162;
    MODELER_PUT(138) = s5*t161 + c5*t163;
    MODELER_PUT(124) = -(t161*t146 - t163*t147 + c4*t159);
    const modeler_lanes t164 = t161*t149 + t163*t150 - t104*t159;
    MODELER_PUT(103) = t164;
    MODELER_PUT(75) = t164;
    MODELER_PUT(28) = t161*t153 - t163*t154 + t108*t159;
    const modeler_lanes t165 = t142 - t162;
    MODELER_PUT(146) = -t165;
    const modeler_lanes t166 = qdd_5 + t114;
    const modeler_lanes t167 = t166 + t141;
    const modeler_lanes t168 = t112 - t157;
    MODELER_PUT(139) = c5*t168 - s5*t167;
    MODELER_PUT(125) = t167*t146 + t147*t168 - c4*t165;
    const modeler_lanes t169 = t167*t149 - t150*t168 + t165*t104;
    MODELER_PUT(104) = -t169;
    MODELER_PUT(76) = -t169;
    MODELER_PUT(29) = t165*t108 - (t167*t153 + t154*t168);
    const modeler_lanes t170 = t160 + t144;
    MODELER_PUT(147) = -t170;
    const modeler_lanes t171 = t112 - t158;
    const modeler_lanes t172 = t166 - t141;
    MODELER_PUT(140) = -(s5*t171 + c5*t172);
    MODELER_PUT(126) = t146*t171 - t172*t147 - c4*t170;
    const modeler_lanes t173 = t149*t171 + t172*t150 + t170*t104;
    MODELER_PUT(105) = -t173;
    MODELER_PUT(77) = -t173;
    MODELER_PUT(30) = t170*t108 - (t153*t171 - t172*t154);
    MODELER_PUT(148) = t166;
    MODELER_PUT(141) = s5*t162 - t145;
    MODELER_PUT(127) = c4*t166 - (t148 + t162*t146);
    const modeler_lanes t174 = t151 - t162*t149 - t166*t104;
    MODELER_PUT(106) = -t174;
    MODELER_PUT(78) = -t174;
    MODELER_PUT(31) = t155 + t162*t153 - t166*t108;
    const modeler_lanes t175 = c5*t82 - s5*t137;
    MODELER_PUT(149) = -t175;
    MODELER_PUT(142) = -c5*t129;
    MODELER_PUT(128) = -(t129*t147 + c4*t175);
    const modeler_lanes t176 = t129*t150 + t175*t104;
    const modeler_lanes t177 = c5*t131 - s5*t86;
    const modeler_lanes t178 = c5*t86 + s5*t131;
    MODELER_PUT(107) = t157*t177 + t167*t178 + t161*t132 - t176;
    const modeler_lanes t179 = c5*t133 - s5*t89;
    const modeler_lanes t180 = c5*t89 + s5*t133;
    MODELER_PUT(79) = t157*t179 + t167*t180 + t161*t134 - t176;
    const modeler_lanes t181 = c5*t135 + s5*t93;
    const modeler_lanes t182 = c5*t93 - s5*t135;
    MODELER_PUT(32) = t129*t154 + t175*t108 + (t157*t181 - t167*t182 + t161*t136);
    const modeler_lanes t183 = c5*t137 + s5*t82;
    MODELER_PUT(150) = t183;
    MODELER_PUT(143) = s5*t129;
    MODELER_PUT(129) = c4*t183 - t129*t146;
    const modeler_lanes t184 = t129*t149 + t183*t104;
    MODELER_PUT(108) = t172*t177 - t158*t178 - t163*t132 + t184;
    MODELER_PUT(80) = t172*t179 - t158*t180 - t163*t134 + t184;
    MODELER_PUT(33) = t129*t153 - t183*t108 + (t172*t181 + t158*t182 - t163*t136);
    const modeler_lanes t185 = s6*qd_0;
    const modeler_lanes t186 = c6*qd_0;
    const modeler_lanes t187 = t185*t186;
    MODELER_PUT(151) = -t187;
    const modeler_lanes t188 = s6*qdd_0;
    const modeler_lanes t189 = qd_6*t186;
    const modeler_lanes t190 = t188 + t189;
    const modeler_lanes t191 = qd_6*t185;
    MODELER_PUT(34) = s6*t190 + c6*t191;
    const modeler_lanes t192 = qd_6*qd_6;
    const modeler_lanes t193 = t186*t186 + t192;
    const modeler_lanes t194 = t185*t185 + t192;
    MODELER_PUT(152) = t194 - t193;
    const modeler_lanes t195 = c6*qdd_0;
    const modeler_lanes t196 = t195 - t191;
    const modeler_lanes t197 = t191 - t196;
    const modeler_lanes t198 = t189 + t190;
    MODELER_PUT(35) = c6*t198 - s6*t197;
    MODELER_PUT(153) = -t188;
    const modeler_lanes t199 = qdd_6 + t187;
    MODELER_PUT(36) = c6*(t16 - t193) - s6*t199;
    MODELER_PUT(154) = -t195;
    MODELER_PUT(37) = -(s6*(t16 - t194) + c6*(qdd_6 - t187));
    MODELER_PUT(155) = qdd_6;
    const modeler_lanes t200 = sr400_tree_geo_g*c6 - s6*t17;
    MODELER_PUT(156) = -t200;
    MODELER_PUT(38) = c6*t19 - sr400_tree_geo_D2*t197;
    const modeler_lanes t201 = c6*t17 + sr400_tree_geo_g*s6;
    MODELER_PUT(157) = t201;
    MODELER_PUT(39) = -(s6*t19 + sr400_tree_geo_D2*t198);
    const modeler_lanes t202 = c7*t185 + s7*t186;
    const modeler_lanes t203 = c7*t186 - s7*t185;
    const modeler_lanes t204 = t202*t203;
    MODELER_PUT(165) = -t204;
    MODELER_PUT(158) = -t204;
    const modeler_lanes t205 = c7*t190 + s7*t196 + qd_7*t203;
    const modeler_lanes t206 = s6*c7 + c6*s7;
    const modeler_lanes t207 = qd_6 + qd_7;
    const modeler_lanes t208 = t202*t207;
    const modeler_lanes t209 = c6*c7 - s6*s7;
    MODELER_PUT(40) = t205*t206 + t208*t209;
    const modeler_lanes t210 = t207*t207;
    const modeler_lanes t211 = t203*t203 + t210;
    const modeler_lanes t212 = t202*t202 + t210;
    const modeler_lanes t213 = t211 - t212;
    MODELER_PUT(166) = -t213;
    MODELER_PUT(159) = -t213;
    const modeler_lanes t214 = c7*t196 - s7*t190 - qd_7*t202;
    const modeler_lanes t215 = t214 - t208;
    const modeler_lanes t216 = t203*t207;
    const modeler_lanes t217 = t205 + t216;
    MODELER_PUT(41) = t215*t206 + t217*t209;
    const modeler_lanes t218 = t205 - t216;
    MODELER_PUT(167) = -t218;
    MODELER_PUT(160) = -t218;
    const modeler_lanes t219 = qdd_6 + qdd_7;
    const modeler_lanes t220 = t219 + t204;
    MODELER_PUT(42) = t209*(t16 - t211) - t220*t206;
    const modeler_lanes t221 = t214 + t208;
    MODELER_PUT(168) = -t221;
    MODELER_PUT(161) = -t221;
    const modeler_lanes t222 = t219 - t204;
    MODELER_PUT(43) = -(t206*(t16 - t212) + t222*t209);
    MODELER_PUT(169) = t219;
    MODELER_PUT(162) = t219;
    const modeler_lanes t223 = t200 - sr400_tree_geo_D8*t199;
    const modeler_lanes t224 = t201 + sr400_tree_geo_D8*t193;
    const modeler_lanes t225 = c7*t223 - s7*t224;
    MODELER_PUT(170) = -t225;
    const modeler_lanes t226 = sr400_tree_geo_D8*s7;
    const modeler_lanes t227 = sr400_tree_geo_D8*c7;
    MODELER_PUT(163) = -(t211*t226 - t220*t227 + t225);
    const modeler_lanes t228 = t19 - sr400_tree_geo_D8*t197;
    const modeler_lanes t229 = sr400_tree_geo_D2 + sr400_tree_geo_D8*c6;
    MODELER_PUT(44) = t228*t209 + t215*t229;
    const modeler_lanes t230 = c7*t224 + s7*t223;
    MODELER_PUT(171) = t230;
    MODELER_PUT(164) = t230 - (t222*t226 + t212*t227);
    MODELER_PUT(45) = -(t228*t206 + t217*t229);
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
