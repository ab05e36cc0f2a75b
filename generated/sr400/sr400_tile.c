/* SR400, 6R arm with a parallelogram
 *
 * Functions of sr400_tile.h.
 * This file includes itself once for every instruction set.
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
    {6, 39, 0, 126, row, column, tile_##version}

static const modeler_tiled tiled[] = {MODELER_EACH_VERSION(TILED)};

const modeler_tiled *sr400_tiled(void)
{
    return &tiled[MODELER_BEST_VERSION];
}

const char *sr400_tile_signature(void)
{
    return "805eb0618315098c";
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
    const modeler_lanes t2 = s1*qd_0;
    const modeler_lanes t3 = c1*qd_0;
    const modeler_lanes t4 = t2*t3;
    MODELER_PUT(37) = -t4;
    const modeler_lanes t5 = s1*qdd_0;
    const modeler_lanes t6 = qd_1*t3;
    const modeler_lanes t7 = t5 + t6;
    const modeler_lanes t8 = qd_1*t2;
    MODELER_PUT(1) = s1*t7 + c1*t8;
    const modeler_lanes t9 = qd_1*qd_1;
    const modeler_lanes t10 = t3*t3 + t9;
    const modeler_lanes t11 = t2*t2 + t9;
    MODELER_PUT(38) = t11 - t10;
    const modeler_lanes t12 = c1*qdd_0;
    const modeler_lanes t13 = t12 - t8;
    const modeler_lanes t14 = t8 - t13;
    const modeler_lanes t15 = t6 + t7;
    MODELER_PUT(2) = c1*t15 - s1*t14;
    MODELER_PUT(39) = -t5;
    const modeler_lanes t16 = qdd_1 + t4;
    const modeler_lanes t17 = qd_0*qd_0;
    MODELER_PUT(3) = c1*(t17 - t10) - s1*t16;
    MODELER_PUT(40) = -t12;
    const modeler_lanes t18 = qdd_1 - t4;
    MODELER_PUT(4) = -(s1*(t17 - t11) + c1*t18);
    MODELER_PUT(41) = qdd_1;
    const modeler_lanes t19 = sr400_geo_D2*t17;
    const modeler_lanes t20 = sr400_geo_g*c1 - s1*t19;
    MODELER_PUT(42) = -t20;
    const modeler_lanes t21 = sr400_geo_D2*qdd_0;
    MODELER_PUT(5) = c1*t21 - sr400_geo_D2*t14;
    const modeler_lanes t22 = c1*t19 + sr400_geo_g*s1;
    MODELER_PUT(43) = t22;
    MODELER_PUT(6) = -(s1*t21 + sr400_geo_D2*t15);
    const modeler_lanes t23 = sa2*t2 + ca2*t3;
    const modeler_lanes t24 = sa2*t3 - ca2*t2;
    const modeler_lanes t25 = t23*t24;
    MODELER_PUT(95) = -t25;
    const modeler_lanes t26 = qd_1 - qd_5;
    const modeler_lanes t27 = sa2*t7 + ca2*t13 - t26*t24;
    const modeler_lanes t28 = qd_5*t23;
    MODELER_PUT(7) = c5*t27 - s5*t28;
    const modeler_lanes t29 = qd_5*qd_5;
    const modeler_lanes t30 = t24*t24 + t29;
    const modeler_lanes t31 = t23*t23 + t29;
    MODELER_PUT(96) = t31 - t30;
    const modeler_lanes t32 = sa2*t13 - ca2*t7 + t26*t23;
    const modeler_lanes t33 = t32 - t28;
    const modeler_lanes t34 = qd_5*t24;
    const modeler_lanes t35 = t27 + t34;
    MODELER_PUT(8) = c5*t33 - s5*t35;
    MODELER_PUT(97) = t34 - t27;
    const modeler_lanes t36 = qdd_5 + t25;
    MODELER_PUT(9) = -(c5*t36 + s5*(t17 - t30));
    MODELER_PUT(98) = -(t32 + t28);
    const modeler_lanes t37 = qdd_5 - t25;
    MODELER_PUT(10) = s5*t37 - c5*(t17 - t31);
    MODELER_PUT(99) = qdd_5;
    const modeler_lanes t38 = t20 - sr400_geo_D3*t16;
    const modeler_lanes t39 = t22 + sr400_geo_D3*t10;
    const modeler_lanes t40 = sa2*t38 - ca2*t39;
    MODELER_PUT(100) = -t40;
    const modeler_lanes t41 = sr400_geo_D3*ca2;
    const modeler_lanes t42 = sr400_geo_D3*sa2;
    MODELER_PUT(44) = t36*t42 - t30*t41;
    const modeler_lanes t43 = t21 - sr400_geo_D3*t14;
    const modeler_lanes t44 = sr400_geo_D2 + sr400_geo_D3*c1;
    MODELER_PUT(11) = t44*t33 - s5*t43;
    const modeler_lanes t45 = sa2*t39 + ca2*t38;
    MODELER_PUT(101) = t45;
    MODELER_PUT(45) = -(t37*t41 + t31*t42);
    MODELER_PUT(12) = -(c5*t43 + t44*t35);
    const modeler_lanes t46 = c2*qd_5 - s2*t23;
    const modeler_lanes t47 = c2*t27 + s2*qdd_5 + qd_2*t46;
    const modeler_lanes t48 = c2*t23 + s2*qd_5;
    const modeler_lanes t49 = qd_2 - t24;
    const modeler_lanes t50 = t48*t49;
    const modeler_lanes t51 = c2*t50;
    MODELER_PUT(102) = s2*t47 + t51;
    const modeler_lanes t52 = t48*t46;
    MODELER_PUT(53) = -t52;
    const modeler_lanes t53 = c2*c5;
    const modeler_lanes t54 = s2*c5;
    const modeler_lanes t55 = t50*t54;
    MODELER_PUT(13) = t47*t53 - t55 - s5*t52;
    const modeler_lanes t56 = c2*qdd_5 - s2*t27 - qd_2*t48;
    const modeler_lanes t57 = t56 - t50;
    const modeler_lanes t58 = t46*t49;
    const modeler_lanes t59 = t47 + t58;
    MODELER_PUT(103) = s2*t57 + c2*t59;
    const modeler_lanes t60 = t49*t49;
    const modeler_lanes t61 = t46*t46 + t60;
    const modeler_lanes t62 = t48*t48 + t60;
    const modeler_lanes t63 = t61 - t62;
    MODELER_PUT(54) = -t63;
    MODELER_PUT(14) = t57*t53 - t59*t54 - s5*t63;
    const modeler_lanes t64 = qdd_2 - t32;
    const modeler_lanes t65 = t64 + t52;
    const modeler_lanes t66 = t31 - t61;
    MODELER_PUT(104) = c2*t66 - s2*t65;
    const modeler_lanes t67 = t47 - t58;
    MODELER_PUT(55) = -t67;
    MODELER_PUT(15) = -(t65*t53 + t54*t66 + s5*t67);
    const modeler_lanes t68 = t31 - t62;
    const modeler_lanes t69 = t64 - t52;
    MODELER_PUT(105) = -(s2*t68 + c2*t69);
    const modeler_lanes t70 = t56 + t50;
    MODELER_PUT(56) = -t70;
    MODELER_PUT(16) = -(t53*t68 - t69*t54 + s5*t70);
    MODELER_PUT(106) = s2*t58 - t51;
    MODELER_PUT(57) = t64;
    MODELER_PUT(17) = t55 + t58*t53 + s5*t64;
    const modeler_lanes t71 = sr400_geo_RL4*t31 - sr400_geo_D4*t36 + t40;
    const modeler_lanes t72 = sr400_geo_RL4*c2;
    const modeler_lanes t73 = sr400_geo_RL4*s2;
    MODELER_PUT(107) = t61*t72 + t65*t73 + sr400_geo_D4*t57 - c2*t71;
    const modeler_lanes t74 = sr400_geo_D4*t33 - sr400_geo_RL4*t35 + t43;
    const modeler_lanes t75 = sr400_geo_D4*t30 + sr400_geo_RL4*t37 + t45;
    const modeler_lanes t76 = c2*t74 - s2*t75;
    MODELER_PUT(58) = -t76;
    const modeler_lanes t77 = sr400_geo_RL4 - t41;
    const modeler_lanes t78 = c2*t77;
    const modeler_lanes t79 = t78 - t72;
    const modeler_lanes t80 = s2*t77;
    const modeler_lanes t81 = t80 - t73;
    MODELER_PUT(46) = t61*t79 + t65*t81 + t57*t42;
    const modeler_lanes t82 = t44 - (sr400_geo_RL4*c5 + sr400_geo_D4*s5);
    const modeler_lanes t83 = s2*t82;
    const modeler_lanes t84 = c2*t82;
    MODELER_PUT(18) = t71*t54 - s5*t76 + (t61*t83 - t65*t84);
    MODELER_PUT(108) = t69*t72 - t62*t73 - sr400_geo_D4*t59 + s2*t71;
    const modeler_lanes t85 = c2*t75 + s2*t74;
    MODELER_PUT(59) = t85;
    MODELER_PUT(47) = t69*t79 - t62*t81 - t59*t42;
    MODELER_PUT(19) = t71*t53 + s5*t85 + (t69*t83 + t62*t84);
    const modeler_lanes t86 = c3*t49 + s3*t48;
    const modeler_lanes t87 = c3*t47 - s3*t64 - qd_3*t86;
    const modeler_lanes t88 = s2*c3;
    const modeler_lanes t89 = c3*t48 - s3*t49;
    const modeler_lanes t90 = qd_3 + t46;
    const modeler_lanes t91 = t89*t90;
    const modeler_lanes t92 = s2*s3;
    const modeler_lanes t93 = t91*t92;
    const modeler_lanes t94 = t89*t86;
    MODELER_PUT(109) = t87*t88 - t93 + c2*t94;
    MODELER_PUT(74) = t94;
    const modeler_lanes t95 = c3*t91;
    MODELER_PUT(60) = -(s3*t87 + t95);
    const modeler_lanes t96 = c3*t53 - s3*s5;
    const modeler_lanes t97 = c3*s5 + s3*t53;
    const modeler_lanes t98 = t91*t97;
    MODELER_PUT(20) = t87*t96 - t98 - t94*t54;
    const modeler_lanes t99 = c3*t64 + s3*t47 + qd_3*t89;
    const modeler_lanes t100 = t99 + t91;
    const modeler_lanes t101 = t86*t90;
    const modeler_lanes t102 = t87 - t101;
    const modeler_lanes t103 = t90*t90;
    const modeler_lanes t104 = t86*t86 + t103;
    const modeler_lanes t105 = t89*t89 + t103;
    const modeler_lanes t106 = t104 - t105;
    MODELER_PUT(110) = -(t100*t88 + t102*t92 + c2*t106);
    MODELER_PUT(75) = -t106;
    MODELER_PUT(61) = s3*t100 - c3*t102;
    MODELER_PUT(21) = t54*t106 - (t100*t96 + t102*t97);
    const modeler_lanes t107 = qdd_3 + t56;
    const modeler_lanes t108 = t107 - t94;
    const modeler_lanes t109 = t62 - t104;
    const modeler_lanes t110 = t87 + t101;
    MODELER_PUT(111) = -(t108*t88 + t92*t109 + c2*t110);
    MODELER_PUT(76) = -t110;
    MODELER_PUT(62) = s3*t108 - c3*t109;
    MODELER_PUT(22) = t110*t54 - (t108*t96 + t97*t109);
    const modeler_lanes t111 = t62 - t105;
    const modeler_lanes t112 = t107 + t94;
    const modeler_lanes t113 = t99 - t91;
    MODELER_PUT(112) = c2*t113 - (t88*t111 - t112*t92);
    MODELER_PUT(77) = t113;
    MODELER_PUT(63) = s3*t111 + c3*t112;
    MODELER_PUT(23) = -(t96*t111 - t112*t97 + t113*t54);
    MODELER_PUT(113) = t93 - t101*t88 + c2*t107;
    MODELER_PUT(78) = t107;
    MODELER_PUT(64) = t95 + s3*t101;
    MODELER_PUT(24) = t98 - t101*t96 - t107*t54;
    const modeler_lanes t114 = c3*t71 - s3*t85;
    const modeler_lanes t115 = c3*t72 - sr400_geo_D4*s3;
    const modeler_lanes t116 = sr400_geo_D4*c3 + s3*t72;
    MODELER_PUT(114) = t104*t115 + t108*t116 + t100*t73 - (t76*t92 + c2*t114);
    MODELER_PUT(79) = -t114;
    MODELER_PUT(65) = -c3*t76;
    const modeler_lanes t117 = sr400_geo_D4 + t42;
    const modeler_lanes t118 = c3*t78 - s3*t117;
    const modeler_lanes t119 = t118 - t115;
    const modeler_lanes t120 = c3*t117 + s3*t78 - t116;
    MODELER_PUT(48) = t104*t119 + t108*t120 + t100*t81;
    const modeler_lanes t121 = c3*t83;
    const modeler_lanes t122 = s3*t83;
    MODELER_PUT(25) = t104*t121 + t108*t122 - t100*t84 - (t76*t97 - t114*t54);
    const modeler_lanes t123 = c3*t85 + s3*t71;
    MODELER_PUT(115) = t112*t115 - t105*t116 + t102*t73 - (t76*t88 - c2*t123);
    MODELER_PUT(80) = t123;
    MODELER_PUT(66) = s3*t76;
    MODELER_PUT(49) = t112*t119 - t105*t120 + t102*t81;
    MODELER_PUT(26) = t112*t121 - t105*t122 - t102*t84 - (t76*t96 + t123*t54);
    const modeler_lanes t124 = c4*t90 - s4*t89;
    const modeler_lanes t125 = c4*t87 + s4*t107 + qd_4*t124;
    const modeler_lanes t126 = c4*t88 + c2*s4;
    const modeler_lanes t127 = c4*t89 + s4*t90;
    const modeler_lanes t128 = qd_4 + t86;
    const modeler_lanes t129 = t127*t128;
    const modeler_lanes t130 = c2*c4 - s4*t88;
    const modeler_lanes t131 = t129*t130;
    const modeler_lanes t132 = t127*t124;
    MODELER_PUT(116) = t125*t126 + t131 - t132*t92;
    MODELER_PUT(88) = -t132;
    const modeler_lanes t133 = c4*t129;
    MODELER_PUT(81) = s4*t125 + t133;
    const modeler_lanes t134 = s3*c4;
    const modeler_lanes t135 = s3*s4;
    const modeler_lanes t136 = t129*t135;
    MODELER_PUT(67) = -(t125*t134 - t136 + c3*t132);
    const modeler_lanes t137 = c4*t96 - s4*t54;
    const modeler_lanes t138 = c4*t54 + s4*t96;
    const modeler_lanes t139 = t129*t138;
    MODELER_PUT(27) = t125*t137 - t139 - t132*t97;
    const modeler_lanes t140 = c4*t107 - s4*t87 - qd_4*t127;
    const modeler_lanes t141 = t140 - t129;
    const modeler_lanes t142 = t124*t128;
    const modeler_lanes t143 = t125 + t142;
    const modeler_lanes t144 = t128*t128;
    const modeler_lanes t145 = t124*t124 + t144;
    const modeler_lanes t146 = t127*t127 + t144;
    const modeler_lanes t147 = t145 - t146;
    MODELER_PUT(117) = t141*t126 + t143*t130 - t92*t147;
    MODELER_PUT(89) = -t147;
    MODELER_PUT(82) = s4*t141 + c4*t143;
    MODELER_PUT(68) = -(t141*t134 - t143*t135 + c3*t147);
    MODELER_PUT(28) = t141*t137 - t143*t138 - t97*t147;
    const modeler_lanes t148 = qdd_4 + t99;
    const modeler_lanes t149 = t148 + t132;
    const modeler_lanes t150 = t105 - t145;
    const modeler_lanes t151 = t125 - t142;
    MODELER_PUT(118) = -(t149*t126 - t130*t150 + t151*t92);
    MODELER_PUT(90) = -t151;
    MODELER_PUT(83) = c4*t150 - s4*t149;
    MODELER_PUT(69) = t149*t134 + t135*t150 - c3*t151;
    MODELER_PUT(29) = -(t149*t137 + t138*t150 + t151*t97);
    const modeler_lanes t152 = t105 - t146;
    const modeler_lanes t153 = t148 - t132;
    const modeler_lanes t154 = t140 + t129;
    MODELER_PUT(119) = -(t126*t152 + t153*t130 + t154*t92);
    MODELER_PUT(91) = -t154;
    MODELER_PUT(84) = -(s4*t152 + c4*t153);
    MODELER_PUT(70) = t134*t152 - t153*t135 - c3*t154;
    MODELER_PUT(30) = -(t137*t152 - t153*t138 + t154*t97);
    MODELER_PUT(120) = t148*t92 - (t131 - t142*t126);
    MODELER_PUT(92) = t148;
    MODELER_PUT(85) = s4*t142 - t133;
    MODELER_PUT(71) = c3*t148 - (t136 + t142*t134);
    MODELER_PUT(31) = t139 + t142*t137 + t148*t97;
    const modeler_lanes t155 = c4*t76 - s4*t123;
    const modeler_lanes t156 = c4*t115 - s4*t73;
    const modeler_lanes t157 = c4*t73 + s4*t115;
    MODELER_PUT(121) = t145*t156 + t149*t157 + t141*t116 - (t114*t130 + t155*t92);
    MODELER_PUT(93) = -t155;
    MODELER_PUT(86) = -c4*t114;
    MODELER_PUT(72) = -(t114*t135 + c3*t155);
    const modeler_lanes t158 = c4*t118 - s4*t80 - t156;
    const modeler_lanes t159 = c4*t80 + s4*t118 - t157;
    MODELER_PUT(50) = t145*t158 + t149*t159 + t141*t120;
    const modeler_lanes t160 = c4*t121 + s4*t84;
    const modeler_lanes t161 = c4*t84 - s4*t121;
    MODELER_PUT(32) = t114*t138 - t155*t97 + (t145*t160 - t149*t161 + t141*t122);
    const modeler_lanes t162 = c4*t123 + s4*t76;
    MODELER_PUT(122) = t114*t126 + t162*t92 + (t153*t156 - t146*t157 - t143*t116);
    MODELER_PUT(94) = t162;
    MODELER_PUT(87) = s4*t114;
    MODELER_PUT(73) = c3*t162 - t114*t134;
    MODELER_PUT(51) = t153*t158 - t146*t159 - t143*t120;
    MODELER_PUT(33) = t114*t137 + t162*t97 + (t153*t160 + t146*t161 - t143*t122);
    const modeler_lanes t163 = sr400_geo_g*c5 - s5*t19;
    MODELER_PUT(123) = -t163;
    MODELER_PUT(34) = c5*t21 + sr400_geo_D2*t35;
    const modeler_lanes t164 = c5*t19 + sr400_geo_g*s5;
    MODELER_PUT(124) = t164;
    MODELER_PUT(35) = sr400_geo_D2*t33 - s5*t21;
    MODELER_PUT(125) = -(sr400_geo_D8*sa2*t18 + sr400_geo_D8*ca2*t11);
    MODELER_PUT(52) = ca2*(t164 + sr400_geo_D8*t31) + sa2*(t163 - sr400_geo_D8*t37);
    MODELER_PUT(36) = -(s1*(t21 + sr400_geo_D8*t35) + (sr400_geo_D2 + sr400_geo_D8*c5)*t15);
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
