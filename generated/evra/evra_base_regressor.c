/* Evr@ simulator, 6-UPS platform on two sliders (Houda, Amouri, Beji, Mallem)
 *
 * Functions of evra.h.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#include "evra.h"

#include <math.h>

#include "modeler_runtime.h"
#include "modeler_sincos.h"
#include "evra_tree.h"

/* Geometry. To use another value, compile with e.g. -DEVRA_GEO_g=9.81
 * or any constant expression of C; mind that 1/2 is 0 there, 1.0/2 is not. */
#ifndef EVRA_GEO_g
#define EVRA_GEO_g 9.81
#endif
#ifndef EVRA_GEO_RB
#define EVRA_GEO_RB 0.6
#endif
#ifndef EVRA_GEO_RP
#define EVRA_GEO_RP 0.35
#endif
#ifndef EVRA_GEO_beta1
#define EVRA_GEO_beta1 0.1745
#endif
#ifndef EVRA_GEO_beta2
#define EVRA_GEO_beta2 1.9199
#endif
#ifndef EVRA_GEO_beta3
#define EVRA_GEO_beta3 2.2689
#endif
#ifndef EVRA_GEO_beta4
#define EVRA_GEO_beta4 4.0143
#endif
#ifndef EVRA_GEO_beta5
#define EVRA_GEO_beta5 4.3633
#endif
#ifndef EVRA_GEO_beta6
#define EVRA_GEO_beta6 6.1087
#endif
#ifndef EVRA_GEO_phi1
#define EVRA_GEO_phi1 0.8727
#endif
#ifndef EVRA_GEO_phi2
#define EVRA_GEO_phi2 1.2217
#endif
#ifndef EVRA_GEO_phi3
#define EVRA_GEO_phi3 2.9671
#endif
#ifndef EVRA_GEO_phi4
#define EVRA_GEO_phi4 3.3161
#endif
#ifndef EVRA_GEO_phi5
#define EVRA_GEO_phi5 5.0615
#endif
#ifndef EVRA_GEO_phi6
#define EVRA_GEO_phi6 5.4105
#endif

static const double evra_geo_g = EVRA_GEO_g;
static const double evra_geo_beta1 = EVRA_GEO_beta1;
static const double evra_geo_beta2 = EVRA_GEO_beta2;
static const double evra_geo_beta3 = EVRA_GEO_beta3;
static const double evra_geo_beta4 = EVRA_GEO_beta4;
static const double evra_geo_beta5 = EVRA_GEO_beta5;
static const double evra_geo_beta6 = EVRA_GEO_beta6;

/* Regressor of the base parameters.
 * 366 additions, 602 multiplications. */
void evra_tree_base_regressor(const double *q, const double *qd, const double *qdd,
                              double *MODELER_RESTRICT phi)
{
    for (int i = 0; i < 2340; i++)
        phi[i] = 0.0;

    const double k1 = cos(evra_geo_beta1);
    const double k2 = sin(evra_geo_beta1);
    const double k3 = cos(evra_geo_beta2);
    const double k4 = sin(evra_geo_beta2);
    const double k5 = cos(evra_geo_beta3);
    const double k6 = sin(evra_geo_beta3);
    const double k7 = cos(evra_geo_beta4);
    const double k8 = sin(evra_geo_beta4);
    const double k9 = cos(evra_geo_beta5);
    const double k10 = sin(evra_geo_beta5);
    const double k11 = cos(evra_geo_beta6);
    const double k12 = sin(evra_geo_beta6);

    double s3, c3;
    modeler_sincos(q[3], &s3, &c3);
    double s4, c4;
    modeler_sincos(q[4], &s4, &c4);
    double s5, c5;
    modeler_sincos(q[5], &s5, &c5);
    double s8, c8;
    modeler_sincos(q[8], &s8, &c8);
    double s9, c9;
    modeler_sincos(q[9], &s9, &c9);
    double s11, c11;
    modeler_sincos(q[11], &s11, &c11);
    double s12, c12;
    modeler_sincos(q[12], &s12, &c12);
    double s14, c14;
    modeler_sincos(q[14], &s14, &c14);
    double s15, c15;
    modeler_sincos(q[15], &s15, &c15);
    double s17, c17;
    modeler_sincos(q[17], &s17, &c17);
    double s18, c18;
    modeler_sincos(q[18], &s18, &c18);
    double s20, c20;
    modeler_sincos(q[20], &s20, &c20);
    double s21, c21;
    modeler_sincos(q[21], &s21, &c21);
    double s23, c23;
    modeler_sincos(q[23], &s23, &c23);
    double s24, c24;
    modeler_sincos(q[24], &s24, &c24);

    const double t1 = c4*c5;
    const double t2 = s4*qd[3];
    const double t3 = c4*qdd[3] - qd[4]*t2;
    const double t4 = c4*qd[3];
    const double t5 = c5*qd[4] - s5*t4;
    const double t6 = c5*t3 + s5*qdd[4] + qd[5]*t5;
    const double t7 = c4*s5;
    const double t8 = c5*t4 + s5*qd[4];
    const double t9 = qd[5] + t2;
    const double t10 = t8*t9;
    const double t11 = t7*t10;
    const double t12 = t8*t5;
    const double t13 = s4*t12;
    phi[270] = t1*t6 - t11 - t13;
    const double t14 = c5*t10;
    phi[360] = s5*t6 + t14;
    phi[450] = -t12;
    const double t15 = c5*qdd[4] - s5*t3 - qd[5]*t8;
    const double t16 = t15 - t10;
    const double t17 = t5*t9;
    const double t18 = t6 + t17;
    const double t19 = t9*t9;
    const double t20 = t5*t5 + t19;
    const double t21 = t8*t8 + t19;
    const double t22 = t20 - t21;
    phi[271] = t1*t16 - t7*t18 - s4*t22;
    phi[361] = s5*t16 + c5*t18;
    phi[451] = -t22;
    const double t23 = s4*qdd[3] + qd[4]*t4 + qdd[5];
    const double t24 = t23 + t12;
    const double t25 = t4*t4 + qd[4]*qd[4];
    const double t26 = t25 - t20;
    const double t27 = t6 - t17;
    phi[272] = t1*t24 + t7*t26 + s4*t27;
    phi[362] = s5*t24 - c5*t26;
    phi[452] = t27;
    const double t28 = t1*t17;
    phi[273] = t13 - (t28 + t7*t15);
    const double t29 = s5*t17;
    phi[363] = c5*t15 - t29;
    phi[453] = t12;
    const double t30 = t25 - t21;
    const double t31 = t23 - t12;
    const double t32 = t15 + t10;
    phi[274] = t1*t30 - t7*t31 + s4*t32;
    phi[364] = s5*t30 + c5*t31;
    phi[454] = t32;
    phi[275] = t11 + t28 + s4*t23;
    phi[365] = t29 - t14;
    phi[455] = t23;
    phi[6] = -(t1*t20 + t7*t24 + s4*t16);
    const double t33 = s3*s4;
    const double t34 = c5*t33 + c3*s5;
    const double t35 = c3*c5 - s5*t33;
    const double t36 = s3*c4;
    phi[96] = t36*t16 - (t34*t20 - t35*t24);
    const double t37 = c3*s4;
    const double t38 = c5*t37 - s3*s5;
    const double t39 = s3*c5 + s5*t37;
    const double t40 = c3*c4;
    phi[186] = t38*t20 + t39*t24 - t40*t16;
    const double t41 = qdd[2] + evra_geo_g;
    const double t42 = c3*t41 - s3*qdd[1];
    const double t43 = c4*t42 + s4*qdd[0];
    const double t44 = c3*qdd[1] + s3*t41;
    const double t45 = c4*qdd[0] - s4*t42;
    const double t46 = c5*t44 - s5*t45;
    phi[276] = t7*t43 + s4*t46;
    phi[366] = -c5*t43;
    phi[456] = t46;
    phi[7] = s4*t18 - (t1*t31 - t7*t21);
    phi[97] = -(t34*t31 + t35*t21 + t36*t18);
    phi[187] = t38*t31 - t39*t21 + t40*t18;
    const double t47 = c5*t45 + s5*t44;
    phi[277] = t1*t43 - s4*t47;
    phi[367] = s5*t43;
    phi[457] = -t47;
    phi[8] = t1*t32 + t7*t27 - s4*t25;
    phi[98] = t34*t32 - t35*t27 + t36*t25;
    phi[188] = -(t38*t32 + t39*t27 + t40*t25);
    phi[278] = -(t1*t46 + t7*t47);
    phi[368] = t45;
    phi[9] = qdd[0];
    phi[99] = qdd[1];
    phi[189] = t41;
    phi[550] = qdd[6];
    phi[551] = qdd[6];
    phi[641] = qdd[7];
    phi[732] = qdd[8];
    const double t48 = k1*s8;
    const double t49 = qd[8]*qd[8];
    const double t50 = k1*c8;
    phi[553] = t48*t49 - t50*qdd[8];
    const double t51 = k2*s8;
    const double t52 = k2*c8;
    phi[643] = t51*t49 - t52*qdd[8];
    const double t53 = k1*qdd[6] + k2*qdd[7];
    const double t54 = evra_geo_g*s8 - c8*t53;
    phi[733] = t54;
    const double t55 = t48*qdd[8] + t50*t49;
    phi[554] = t55;
    const double t56 = t51*qdd[8] + t52*t49;
    phi[644] = t56;
    const double t57 = s8*t53 + evra_geo_g*c8;
    phi[734] = t57;
    const double t58 = c9*qdd[8];
    const double t59 = s9*qd[8];
    const double t60 = qd[9]*t59;
    const double t61 = t58 - t60;
    const double t62 = c9*qd[8];
    const double t63 = qd[9]*t62;
    phi[735] = c9*t61 - s9*t63;
    const double t64 = t62*t59;
    phi[825] = t64;
    const double t65 = s9*qdd[8];
    const double t66 = t65 + t63 + t63;
    const double t67 = t60 - t61;
    phi[736] = s9*t67 - c9*t66;
    const double t68 = qd[9]*qd[9];
    const double t69 = t59*t59 + t68;
    const double t70 = t62*t62 + t68;
    phi[826] = t70 - t69;
    const double t71 = qdd[9] - t64;
    phi[737] = c9*t71 + s9*(t49 - t69);
    phi[827] = t58;
    const double t72 = qdd[9] + t64;
    phi[738] = c9*(t49 - t70) - s9*t72;
    phi[828] = -t65;
    phi[829] = qdd[9];
    const double t73 = s9*t48 - k2*c9;
    const double t74 = k2*s9 + c9*t48;
    const double t75 = t73*t69 - t74*t71 - t50*t66;
    phi[560] = -t75;
    const double t76 = s9*t51 + k1*c9;
    const double t77 = k1*s9 - c9*t51;
    const double t78 = t76*t69 + t77*t71 - t52*t66;
    phi[650] = -t78;
    phi[740] = -s9*t54;
    const double t79 = k1*qdd[7] - k2*qdd[6];
    const double t80 = s9*t79 - c9*t57;
    phi[830] = -t80;
    const double t81 = t73*t72 + t74*t70 + t50*t67;
    phi[561] = -t81;
    const double t82 = t76*t72 - t77*t70 + t52*t67;
    phi[651] = -t82;
    phi[741] = -c9*t54;
    const double t83 = s9*t57 + c9*t79;
    phi[831] = -t83;
    phi[562] = -t75;
    phi[652] = -t78;
    const double t84 = t54 - q[10]*t67 + qd[10]*t62*2.0;
    const double t85 = c9*q[10];
    phi[742] = -(s9*t84 + t66*t85);
    const double t86 = t80 - q[10]*t70 + qdd[10];
    phi[832] = -(t86 + q[10]*t69);
    phi[922] = -t71;
    phi[563] = -t55;
    phi[653] = -t56;
    const double t87 = q[10]*t72;
    const double t88 = t83 + t87 + qd[9]*qd[10]*2.0;
    phi[743] = c9*t86 - s9*t88 + t49*t85;
    phi[833] = -q[10]*t65;
    phi[923] = t58;
    phi[564] = t81;
    phi[654] = t82;
    phi[744] = c9*t84 - t67*t85;
    phi[834] = t87 + t88;
    phi[924] = -t70;
    phi[1015] = qdd[11];
    const double t89 = k3*s11;
    const double t90 = qd[11]*qd[11];
    const double t91 = k3*c11;
    phi[566] = t89*t90 - t91*qdd[11];
    const double t92 = k4*s11;
    const double t93 = k4*c11;
    phi[656] = t92*t90 - t93*qdd[11];
    const double t94 = k3*qdd[6] + k4*qdd[7];
    const double t95 = evra_geo_g*s11 - c11*t94;
    phi[1016] = t95;
    const double t96 = t89*qdd[11] + t91*t90;
    phi[567] = t96;
    const double t97 = t92*qdd[11] + t93*t90;
    phi[657] = t97;
    const double t98 = s11*t94 + evra_geo_g*c11;
    phi[1017] = t98;
    const double t99 = c12*qdd[11];
    const double t100 = s12*qd[11];
    const double t101 = qd[12]*t100;
    const double t102 = t99 - t101;
    const double t103 = c12*qd[11];
    const double t104 = qd[12]*t103;
    phi[1018] = c12*t102 - s12*t104;
    const double t105 = t103*t100;
    phi[1108] = t105;
    const double t106 = s12*qdd[11];
    const double t107 = t106 + t104 + t104;
    const double t108 = t101 - t102;
    phi[1019] = s12*t108 - c12*t107;
    const double t109 = qd[12]*qd[12];
    const double t110 = t100*t100 + t109;
    const double t111 = t103*t103 + t109;
    phi[1109] = t111 - t110;
    const double t112 = qdd[12] - t105;
    phi[1020] = c12*t112 + s12*(t90 - t110);
    phi[1110] = t99;
    const double t113 = qdd[12] + t105;
    phi[1021] = c12*(t90 - t111) - s12*t113;
    phi[1111] = -t106;
    phi[1112] = qdd[12];
    const double t114 = s12*t89 - k4*c12;
    const double t115 = k4*s12 + c12*t89;
    const double t116 = t114*t110 - t115*t112 - t91*t107;
    phi[573] = -t116;
    const double t117 = s12*t92 + k3*c12;
    const double t118 = k3*s12 - c12*t92;
    const double t119 = t117*t110 + t118*t112 - t93*t107;
    phi[663] = -t119;
    phi[1023] = -s12*t95;
    const double t120 = k3*qdd[7] - k4*qdd[6];
    const double t121 = s12*t120 - c12*t98;
    phi[1113] = -t121;
    const double t122 = t114*t113 + t115*t111 + t91*t108;
    phi[574] = -t122;
    const double t123 = t117*t113 - t118*t111 + t93*t108;
    phi[664] = -t123;
    phi[1024] = -c12*t95;
    const double t124 = s12*t98 + c12*t120;
    phi[1114] = -t124;
    phi[575] = -t116;
    phi[665] = -t119;
    const double t125 = t95 - q[13]*t108 + qd[13]*t103*2.0;
    const double t126 = c12*q[13];
    phi[1025] = -(s12*t125 + t107*t126);
    const double t127 = t121 - q[13]*t111 + qdd[13];
    phi[1115] = -(t127 + q[13]*t110);
    phi[1205] = -t112;
    phi[576] = -t96;
    phi[666] = -t97;
    const double t128 = q[13]*t113;
    const double t129 = t124 + t128 + qd[12]*qd[13]*2.0;
    phi[1026] = c12*t127 - s12*t129 + t90*t126;
    phi[1116] = -q[13]*t106;
    phi[1206] = t99;
    phi[577] = t122;
    phi[667] = t123;
    phi[1027] = c12*t125 - t108*t126;
    phi[1117] = t128 + t129;
    phi[1207] = -t111;
    phi[1298] = qdd[14];
    const double t130 = k5*s14;
    const double t131 = qd[14]*qd[14];
    const double t132 = k5*c14;
    phi[579] = t130*t131 - t132*qdd[14];
    const double t133 = k6*s14;
    const double t134 = k6*c14;
    phi[669] = t133*t131 - t134*qdd[14];
    const double t135 = k5*qdd[6] + k6*qdd[7];
    const double t136 = evra_geo_g*s14 - c14*t135;
    phi[1299] = t136;
    const double t137 = t130*qdd[14] + t132*t131;
    phi[580] = t137;
    const double t138 = t133*qdd[14] + t134*t131;
    phi[670] = t138;
    const double t139 = s14*t135 + evra_geo_g*c14;
    phi[1300] = t139;
    const double t140 = c15*qdd[14];
    const double t141 = s15*qd[14];
    const double t142 = qd[15]*t141;
    const double t143 = t140 - t142;
    const double t144 = c15*qd[14];
    const double t145 = qd[15]*t144;
    phi[1301] = c15*t143 - s15*t145;
    const double t146 = t144*t141;
    phi[1391] = t146;
    const double t147 = s15*qdd[14];
    const double t148 = t147 + t145 + t145;
    const double t149 = t142 - t143;
    phi[1302] = s15*t149 - c15*t148;
    const double t150 = qd[15]*qd[15];
    const double t151 = t141*t141 + t150;
    const double t152 = t144*t144 + t150;
    phi[1392] = t152 - t151;
    const double t153 = qdd[15] - t146;
    phi[1303] = c15*t153 + s15*(t131 - t151);
    phi[1393] = t140;
    const double t154 = qdd[15] + t146;
    phi[1304] = c15*(t131 - t152) - s15*t154;
    phi[1394] = -t147;
    phi[1395] = qdd[15];
    const double t155 = s15*t130 - k6*c15;
    const double t156 = k6*s15 + c15*t130;
    const double t157 = t155*t151 - t156*t153 - t132*t148;
    phi[586] = -t157;
    const double t158 = s15*t133 + k5*c15;
    const double t159 = k5*s15 - c15*t133;
    const double t160 = t158*t151 + t159*t153 - t134*t148;
    phi[676] = -t160;
    phi[1306] = -s15*t136;
    const double t161 = k5*qdd[7] - k6*qdd[6];
    const double t162 = s15*t161 - c15*t139;
    phi[1396] = -t162;
    const double t163 = t155*t154 + t156*t152 + t132*t149;
    phi[587] = -t163;
    const double t164 = t158*t154 - t159*t152 + t134*t149;
    phi[677] = -t164;
    phi[1307] = -c15*t136;
    const double t165 = s15*t139 + c15*t161;
    phi[1397] = -t165;
    phi[588] = -t157;
    phi[678] = -t160;
    const double t166 = t136 - q[16]*t149 + qd[16]*t144*2.0;
    const double t167 = c15*q[16];
    phi[1308] = -(s15*t166 + t148*t167);
    const double t168 = t162 - q[16]*t152 + qdd[16];
    phi[1398] = -(t168 + q[16]*t151);
    phi[1488] = -t153;
    phi[589] = -t137;
    phi[679] = -t138;
    const double t169 = q[16]*t154;
    const double t170 = t165 + t169 + qd[15]*qd[16]*2.0;
    phi[1309] = c15*t168 - s15*t170 + t131*t167;
    phi[1399] = -q[16]*t147;
    phi[1489] = t140;
    phi[590] = t163;
    phi[680] = t164;
    phi[1310] = c15*t166 - t149*t167;
    phi[1400] = t169 + t170;
    phi[1490] = -t152;
    phi[1581] = qdd[17];
    const double t171 = k7*s17;
    const double t172 = qd[17]*qd[17];
    const double t173 = k7*c17;
    phi[592] = t171*t172 - t173*qdd[17];
    const double t174 = k8*s17;
    const double t175 = k8*c17;
    phi[682] = t174*t172 - t175*qdd[17];
    const double t176 = k7*qdd[6] + k8*qdd[7];
    const double t177 = evra_geo_g*s17 - c17*t176;
    phi[1582] = t177;
    const double t178 = t171*qdd[17] + t173*t172;
    phi[593] = t178;
    const double t179 = t174*qdd[17] + t175*t172;
    phi[683] = t179;
    const double t180 = s17*t176 + evra_geo_g*c17;
    phi[1583] = t180;
    const double t181 = c18*qdd[17];
    const double t182 = s18*qd[17];
    const double t183 = qd[18]*t182;
    const double t184 = t181 - t183;
    const double t185 = c18*qd[17];
    const double t186 = qd[18]*t185;
    phi[1584] = c18*t184 - s18*t186;
    const double t187 = t185*t182;
    phi[1674] = t187;
    const double t188 = s18*qdd[17];
    const double t189 = t188 + t186 + t186;
    const double t190 = t183 - t184;
    phi[1585] = s18*t190 - c18*t189;
    const double t191 = qd[18]*qd[18];
    const double t192 = t182*t182 + t191;
    const double t193 = t185*t185 + t191;
    phi[1675] = t193 - t192;
    const double t194 = qdd[18] - t187;
    phi[1586] = c18*t194 + s18*(t172 - t192);
    phi[1676] = t181;
    const double t195 = qdd[18] + t187;
    phi[1587] = c18*(t172 - t193) - s18*t195;
    phi[1677] = -t188;
    phi[1678] = qdd[18];
    const double t196 = s18*t171 - k8*c18;
    const double t197 = k8*s18 + c18*t171;
    const double t198 = t196*t192 - t197*t194 - t173*t189;
    phi[599] = -t198;
    const double t199 = s18*t174 + k7*c18;
    const double t200 = k7*s18 - c18*t174;
    const double t201 = t199*t192 + t200*t194 - t175*t189;
    phi[689] = -t201;
    phi[1589] = -s18*t177;
    const double t202 = k7*qdd[7] - k8*qdd[6];
    const double t203 = s18*t202 - c18*t180;
    phi[1679] = -t203;
    const double t204 = t196*t195 + t197*t193 + t173*t190;
    phi[600] = -t204;
    const double t205 = t199*t195 - t200*t193 + t175*t190;
    phi[690] = -t205;
    phi[1590] = -c18*t177;
    const double t206 = s18*t180 + c18*t202;
    phi[1680] = -t206;
    phi[601] = -t198;
    phi[691] = -t201;
    const double t207 = t177 - q[19]*t190 + qd[19]*t185*2.0;
    const double t208 = c18*q[19];
    phi[1591] = -(s18*t207 + t189*t208);
    const double t209 = t203 - q[19]*t193 + qdd[19];
    phi[1681] = -(t209 + q[19]*t192);
    phi[1771] = -t194;
    phi[602] = -t178;
    phi[692] = -t179;
    const double t210 = q[19]*t195;
    const double t211 = t206 + t210 + qd[18]*qd[19]*2.0;
    phi[1592] = c18*t209 - s18*t211 + t172*t208;
    phi[1682] = -q[19]*t188;
    phi[1772] = t181;
    phi[603] = t204;
    phi[693] = t205;
    phi[1593] = c18*t207 - t190*t208;
    phi[1683] = t210 + t211;
    phi[1773] = -t193;
    phi[1864] = qdd[20];
    const double t212 = k9*s20;
    const double t213 = qd[20]*qd[20];
    const double t214 = k9*c20;
    phi[605] = t212*t213 - t214*qdd[20];
    const double t215 = k10*s20;
    const double t216 = k10*c20;
    phi[695] = t215*t213 - t216*qdd[20];
    const double t217 = k9*qdd[6] + k10*qdd[7];
    const double t218 = evra_geo_g*s20 - c20*t217;
    phi[1865] = t218;
    const double t219 = t212*qdd[20] + t214*t213;
    phi[606] = t219;
    const double t220 = t215*qdd[20] + t216*t213;
    phi[696] = t220;
    const double t221 = s20*t217 + evra_geo_g*c20;
    phi[1866] = t221;
    const double t222 = c21*qdd[20];
    const double t223 = s21*qd[20];
    const double t224 = qd[21]*t223;
    const double t225 = t222 - t224;
    const double t226 = c21*qd[20];
    const double t227 = qd[21]*t226;
    phi[1867] = c21*t225 - s21*t227;
    const double t228 = t226*t223;
    phi[1957] = t228;
    const double t229 = s21*qdd[20];
    const double t230 = t229 + t227 + t227;
    const double t231 = t224 - t225;
    phi[1868] = s21*t231 - c21*t230;
    const double t232 = qd[21]*qd[21];
    const double t233 = t223*t223 + t232;
    const double t234 = t226*t226 + t232;
    phi[1958] = t234 - t233;
    const double t235 = qdd[21] - t228;
    phi[1869] = c21*t235 + s21*(t213 - t233);
    phi[1959] = t222;
    const double t236 = qdd[21] + t228;
    phi[1870] = c21*(t213 - t234) - s21*t236;
    phi[1960] = -t229;
    phi[1961] = qdd[21];
    const double t237 = s21*t212 - k10*c21;
    const double t238 = k10*s21 + c21*t212;
    const double t239 = t237*t233 - t238*t235 - t214*t230;
    phi[612] = -t239;
    const double t240 = s21*t215 + k9*c21;
    const double t241 = k9*s21 - c21*t215;
    const double t242 = t240*t233 + t241*t235 - t216*t230;
    phi[702] = -t242;
    phi[1872] = -s21*t218;
    const double t243 = k9*qdd[7] - k10*qdd[6];
    const double t244 = s21*t243 - c21*t221;
    phi[1962] = -t244;
    const double t245 = t237*t236 + t238*t234 + t214*t231;
    phi[613] = -t245;
    const double t246 = t240*t236 - t241*t234 + t216*t231;
    phi[703] = -t246;
    phi[1873] = -c21*t218;
    const double t247 = s21*t221 + c21*t243;
    phi[1963] = -t247;
    phi[614] = -t239;
    phi[704] = -t242;
    const double t248 = t218 - q[22]*t231 + qd[22]*t226*2.0;
    const double t249 = c21*q[22];
    phi[1874] = -(s21*t248 + t230*t249);
    const double t250 = t244 - q[22]*t234 + qdd[22];
    phi[1964] = -(t250 + q[22]*t233);
    phi[2054] = -t235;
    phi[615] = -t219;
    phi[705] = -t220;
    const double t251 = q[22]*t236;
    const double t252 = t247 + t251 + qd[21]*qd[22]*2.0;
    phi[1875] = c21*t250 - s21*t252 + t213*t249;
    phi[1965] = -q[22]*t229;
    phi[2055] = t222;
    phi[616] = t245;
    phi[706] = t246;
    phi[1876] = c21*t248 - t231*t249;
    phi[1966] = t251 + t252;
    phi[2056] = -t234;
    phi[2147] = qdd[23];
    const double t253 = k11*s23;
    const double t254 = qd[23]*qd[23];
    const double t255 = k11*c23;
    phi[618] = t253*t254 - t255*qdd[23];
    const double t256 = k12*s23;
    const double t257 = k12*c23;
    phi[708] = t256*t254 - t257*qdd[23];
    const double t258 = k11*qdd[6] + k12*qdd[7];
    const double t259 = evra_geo_g*s23 - c23*t258;
    phi[2148] = t259;
    const double t260 = t253*qdd[23] + t255*t254;
    phi[619] = t260;
    const double t261 = t256*qdd[23] + t257*t254;
    phi[709] = t261;
    const double t262 = s23*t258 + evra_geo_g*c23;
    phi[2149] = t262;
    const double t263 = c24*qdd[23];
    const double t264 = s24*qd[23];
    const double t265 = qd[24]*t264;
    const double t266 = t263 - t265;
    const double t267 = c24*qd[23];
    const double t268 = qd[24]*t267;
    phi[2150] = c24*t266 - s24*t268;
    const double t269 = t267*t264;
    phi[2240] = t269;
    const double t270 = s24*qdd[23];
    const double t271 = t270 + t268 + t268;
    const double t272 = t265 - t266;
    phi[2151] = s24*t272 - c24*t271;
    const double t273 = qd[24]*qd[24];
    const double t274 = t264*t264 + t273;
    const double t275 = t267*t267 + t273;
    phi[2241] = t275 - t274;
    const double t276 = qdd[24] - t269;
    phi[2152] = c24*t276 + s24*(t254 - t274);
    phi[2242] = t263;
    const double t277 = qdd[24] + t269;
    phi[2153] = c24*(t254 - t275) - s24*t277;
    phi[2243] = -t270;
    phi[2244] = qdd[24];
    const double t278 = s24*t253 - k12*c24;
    const double t279 = k12*s24 + c24*t253;
    const double t280 = t278*t274 - t279*t276 - t255*t271;
    phi[625] = -t280;
    const double t281 = s24*t256 + k11*c24;
    const double t282 = k11*s24 - c24*t256;
    const double t283 = t281*t274 + t282*t276 - t257*t271;
    phi[715] = -t283;
    phi[2155] = -s24*t259;
    const double t284 = k11*qdd[7] - k12*qdd[6];
    const double t285 = s24*t284 - c24*t262;
    phi[2245] = -t285;
    const double t286 = t278*t277 + t279*t275 + t255*t272;
    phi[626] = -t286;
    const double t287 = t281*t277 - t282*t275 + t257*t272;
    phi[716] = -t287;
    phi[2156] = -c24*t259;
    const double t288 = s24*t262 + c24*t284;
    phi[2246] = -t288;
    phi[627] = -t280;
    phi[717] = -t283;
    const double t289 = t259 - q[25]*t272 + qd[25]*t267*2.0;
    const double t290 = c24*q[25];
    phi[2157] = -(s24*t289 + t271*t290);
    const double t291 = t285 - q[25]*t275 + qdd[25];
    phi[2247] = -(t291 + q[25]*t274);
    phi[2337] = -t276;
    phi[628] = -t260;
    phi[718] = -t261;
    const double t292 = q[25]*t277;
    const double t293 = t288 + t292 + qd[24]*qd[25]*2.0;
    phi[2158] = c24*t291 - s24*t293 + t254*t290;
    phi[2248] = -q[25]*t270;
    phi[2338] = t263;
    phi[629] = t286;
    phi[719] = t287;
    phi[2159] = c24*t289 - t272*t290;
    phi[2249] = t292 + t293;
    phi[2339] = -t275;
}
