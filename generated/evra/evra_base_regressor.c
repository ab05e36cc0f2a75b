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
    const double t2 = c4*qd[3];
    const double t3 = c5*qd[4] - s5*t2;
    const double t4 = s4*qd[3];
    const double t5 = qd[5] + t4;
    const double t6 = t5*t5;
    const double t7 = t3*t3 + t6;
    const double t8 = c4*s5;
    const double t9 = s4*qdd[3] + qd[4]*t2 + qdd[5];
    const double t10 = c5*t2 + s5*qd[4];
    const double t11 = t10*t3;
    const double t12 = t9 + t11;
    const double t13 = c4*qdd[3] - qd[4]*t4;
    const double t14 = c5*qdd[4] - s5*t13 - qd[5]*t10;
    const double t15 = t10*t5;
    const double t16 = t14 - t15;
    phi[6] = -(t1*t7 + t8*t12 + s4*t16);
    const double t17 = t9 - t11;
    const double t18 = t10*t10 + t6;
    const double t19 = c5*t13 + s5*qdd[4] + qd[5]*t3;
    const double t20 = t3*t5;
    const double t21 = t19 + t20;
    phi[7] = s4*t21 - (t1*t17 - t8*t18);
    const double t22 = t14 + t15;
    const double t23 = t19 - t20;
    const double t24 = t2*t2 + qd[4]*qd[4];
    phi[8] = t1*t22 + t8*t23 - s4*t24;
    phi[9] = qdd[0];
    const double t25 = s3*s4;
    const double t26 = c5*t25 + c3*s5;
    const double t27 = c3*c5 - s5*t25;
    const double t28 = s3*c4;
    phi[96] = t28*t16 - (t26*t7 - t27*t12);
    phi[97] = -(t26*t17 + t27*t18 + t28*t21);
    phi[98] = t26*t22 - t27*t23 + t28*t24;
    phi[99] = qdd[1];
    const double t29 = c3*s4;
    const double t30 = c5*t29 - s3*s5;
    const double t31 = s3*c5 + s5*t29;
    const double t32 = c3*c4;
    phi[186] = t30*t7 + t31*t12 - t32*t16;
    phi[187] = t30*t17 - t31*t18 + t32*t21;
    phi[188] = -(t30*t22 + t31*t23 + t32*t24);
    const double t33 = qdd[2] + evra_geo_g;
    phi[189] = t33;
    const double t34 = t8*t15;
    const double t35 = s4*t11;
    phi[270] = t1*t19 - t34 - t35;
    const double t36 = t7 - t18;
    phi[271] = t1*t16 - t8*t21 - s4*t36;
    const double t37 = t24 - t7;
    phi[272] = t1*t12 + t8*t37 + s4*t23;
    const double t38 = t1*t20;
    phi[273] = t35 - (t38 + t8*t14);
    const double t39 = t24 - t18;
    phi[274] = t1*t39 - t8*t17 + s4*t22;
    phi[275] = t34 + t38 + s4*t9;
    const double t40 = c3*t33 - s3*qdd[1];
    const double t41 = c4*t40 + s4*qdd[0];
    const double t42 = c3*qdd[1] + s3*t33;
    const double t43 = c4*qdd[0] - s4*t40;
    const double t44 = c5*t42 - s5*t43;
    phi[276] = t8*t41 + s4*t44;
    const double t45 = c5*t43 + s5*t42;
    phi[277] = t1*t41 - s4*t45;
    phi[278] = -(t1*t44 + t8*t45);
    const double t46 = c5*t15;
    phi[360] = s5*t19 + t46;
    phi[361] = s5*t16 + c5*t21;
    phi[362] = s5*t12 - c5*t37;
    const double t47 = s5*t20;
    phi[363] = c5*t14 - t47;
    phi[364] = s5*t39 + c5*t17;
    phi[365] = t47 - t46;
    phi[366] = -c5*t41;
    phi[367] = s5*t41;
    phi[368] = t43;
    phi[450] = -t11;
    phi[451] = -t36;
    phi[452] = t23;
    phi[453] = t11;
    phi[454] = t22;
    phi[455] = t9;
    phi[456] = t44;
    phi[457] = -t45;
    phi[550] = qdd[6];
    phi[551] = qdd[6];
    const double t48 = k1*s8;
    const double t49 = qd[8]*qd[8];
    const double t50 = k1*c8;
    phi[553] = t48*t49 - t50*qdd[8];
    const double t51 = t48*qdd[8] + t50*t49;
    phi[554] = t51;
    const double t52 = s9*t48 - k2*c9;
    const double t53 = s9*qd[8];
    const double t54 = qd[9]*qd[9];
    const double t55 = t53*t53 + t54;
    const double t56 = k2*s9 + c9*t48;
    const double t57 = c9*qd[8];
    const double t58 = t57*t53;
    const double t59 = qdd[9] - t58;
    const double t60 = qd[9]*t57;
    const double t61 = s9*qdd[8];
    const double t62 = t61 + t60 + t60;
    const double t63 = t52*t55 - t56*t59 - t50*t62;
    phi[560] = -t63;
    const double t64 = qdd[9] + t58;
    const double t65 = t57*t57 + t54;
    const double t66 = qd[9]*t53;
    const double t67 = c9*qdd[8];
    const double t68 = t67 - t66;
    const double t69 = t66 - t68;
    const double t70 = t52*t64 + t56*t65 + t50*t69;
    phi[561] = -t70;
    phi[562] = -t63;
    phi[563] = -t51;
    phi[564] = t70;
    const double t71 = k3*s11;
    const double t72 = qd[11]*qd[11];
    const double t73 = k3*c11;
    phi[566] = t71*t72 - t73*qdd[11];
    const double t74 = t71*qdd[11] + t73*t72;
    phi[567] = t74;
    const double t75 = s12*t71 - k4*c12;
    const double t76 = s12*qd[11];
    const double t77 = qd[12]*qd[12];
    const double t78 = t76*t76 + t77;
    const double t79 = k4*s12 + c12*t71;
    const double t80 = c12*qd[11];
    const double t81 = t80*t76;
    const double t82 = qdd[12] - t81;
    const double t83 = qd[12]*t80;
    const double t84 = s12*qdd[11];
    const double t85 = t84 + t83 + t83;
    const double t86 = t75*t78 - t79*t82 - t73*t85;
    phi[573] = -t86;
    const double t87 = qdd[12] + t81;
    const double t88 = t80*t80 + t77;
    const double t89 = qd[12]*t76;
    const double t90 = c12*qdd[11];
    const double t91 = t90 - t89;
    const double t92 = t89 - t91;
    const double t93 = t75*t87 + t79*t88 + t73*t92;
    phi[574] = -t93;
    phi[575] = -t86;
    phi[576] = -t74;
    phi[577] = t93;
    const double t94 = k5*s14;
    const double t95 = qd[14]*qd[14];
    const double t96 = k5*c14;
    phi[579] = t94*t95 - t96*qdd[14];
    const double t97 = t94*qdd[14] + t96*t95;
    phi[580] = t97;
    const double t98 = s15*t94 - k6*c15;
    const double t99 = s15*qd[14];
    const double t100 = qd[15]*qd[15];
    const double t101 = t99*t99 + t100;
    const double t102 = k6*s15 + c15*t94;
    const double t103 = c15*qd[14];
    const double t104 = t103*t99;
    const double t105 = qdd[15] - t104;
    const double t106 = qd[15]*t103;
    const double t107 = s15*qdd[14];
    const double t108 = t107 + t106 + t106;
    const double t109 = t98*t101 - t102*t105 - t96*t108;
    phi[586] = -t109;
    const double t110 = qdd[15] + t104;
    const double t111 = t103*t103 + t100;
    const double t112 = qd[15]*t99;
    const double t113 = c15*qdd[14];
    const double t114 = t113 - t112;
    const double t115 = t112 - t114;
    const double t116 = t98*t110 + t102*t111 + t96*t115;
    phi[587] = -t116;
    phi[588] = -t109;
    phi[589] = -t97;
    phi[590] = t116;
    const double t117 = k7*s17;
    const double t118 = qd[17]*qd[17];
    const double t119 = k7*c17;
    phi[592] = t117*t118 - t119*qdd[17];
    const double t120 = t117*qdd[17] + t119*t118;
    phi[593] = t120;
    const double t121 = s18*t117 - k8*c18;
    const double t122 = s18*qd[17];
    const double t123 = qd[18]*qd[18];
    const double t124 = t122*t122 + t123;
    const double t125 = k8*s18 + c18*t117;
    const double t126 = c18*qd[17];
    const double t127 = t126*t122;
    const double t128 = qdd[18] - t127;
    const double t129 = qd[18]*t126;
    const double t130 = s18*qdd[17];
    const double t131 = t130 + t129 + t129;
    const double t132 = t121*t124 - t125*t128 - t119*t131;
    phi[599] = -t132;
    const double t133 = qdd[18] + t127;
    const double t134 = t126*t126 + t123;
    const double t135 = qd[18]*t122;
    const double t136 = c18*qdd[17];
    const double t137 = t136 - t135;
    const double t138 = t135 - t137;
    const double t139 = t121*t133 + t125*t134 + t119*t138;
    phi[600] = -t139;
    phi[601] = -t132;
    phi[602] = -t120;
    phi[603] = t139;
    const double t140 = k9*s20;
    const double t141 = qd[20]*qd[20];
    const double t142 = k9*c20;
    phi[605] = t140*t141 - t142*qdd[20];
    const double t143 = t140*qdd[20] + t142*t141;
    phi[606] = t143;
    const double t144 = s21*t140 - k10*c21;
    const double t145 = s21*qd[20];
    const double t146 = qd[21]*qd[21];
    const double t147 = t145*t145 + t146;
    const double t148 = k10*s21 + c21*t140;
    const double t149 = c21*qd[20];
    const double t150 = t149*t145;
    const double t151 = qdd[21] - t150;
    const double t152 = qd[21]*t149;
    const double t153 = s21*qdd[20];
    const double t154 = t153 + t152 + t152;
    const double t155 = t144*t147 - t148*t151 - t142*t154;
    phi[612] = -t155;
    const double t156 = qdd[21] + t150;
    const double t157 = t149*t149 + t146;
    const double t158 = qd[21]*t145;
    const double t159 = c21*qdd[20];
    const double t160 = t159 - t158;
    const double t161 = t158 - t160;
    const double t162 = t144*t156 + t148*t157 + t142*t161;
    phi[613] = -t162;
    phi[614] = -t155;
    phi[615] = -t143;
    phi[616] = t162;
    const double t163 = k11*s23;
    const double t164 = qd[23]*qd[23];
    const double t165 = k11*c23;
    phi[618] = t163*t164 - t165*qdd[23];
    const double t166 = t163*qdd[23] + t165*t164;
    phi[619] = t166;
    const double t167 = s24*t163 - k12*c24;
    const double t168 = s24*qd[23];
    const double t169 = qd[24]*qd[24];
    const double t170 = t168*t168 + t169;
    const double t171 = k12*s24 + c24*t163;
    const double t172 = c24*qd[23];
    const double t173 = t172*t168;
    const double t174 = qdd[24] - t173;
    const double t175 = qd[24]*t172;
    const double t176 = s24*qdd[23];
    const double t177 = t176 + t175 + t175;
    const double t178 = t167*t170 - t171*t174 - t165*t177;
    phi[625] = -t178;
    const double t179 = qdd[24] + t173;
    const double t180 = t172*t172 + t169;
    const double t181 = qd[24]*t168;
    const double t182 = c24*qdd[23];
    const double t183 = t182 - t181;
    const double t184 = t181 - t183;
    const double t185 = t167*t179 + t171*t180 + t165*t184;
    phi[626] = -t185;
    phi[627] = -t178;
    phi[628] = -t166;
    phi[629] = t185;
    phi[641] = qdd[7];
    const double t186 = k2*s8;
    const double t187 = k2*c8;
    phi[643] = t186*t49 - t187*qdd[8];
    const double t188 = t186*qdd[8] + t187*t49;
    phi[644] = t188;
    const double t189 = s9*t186 + k1*c9;
    const double t190 = k1*s9 - c9*t186;
    const double t191 = t189*t55 + t190*t59 - t187*t62;
    phi[650] = -t191;
    const double t192 = t189*t64 - t190*t65 + t187*t69;
    phi[651] = -t192;
    phi[652] = -t191;
    phi[653] = -t188;
    phi[654] = t192;
    const double t193 = k4*s11;
    const double t194 = k4*c11;
    phi[656] = t193*t72 - t194*qdd[11];
    const double t195 = t193*qdd[11] + t194*t72;
    phi[657] = t195;
    const double t196 = s12*t193 + k3*c12;
    const double t197 = k3*s12 - c12*t193;
    const double t198 = t196*t78 + t197*t82 - t194*t85;
    phi[663] = -t198;
    const double t199 = t196*t87 - t197*t88 + t194*t92;
    phi[664] = -t199;
    phi[665] = -t198;
    phi[666] = -t195;
    phi[667] = t199;
    const double t200 = k6*s14;
    const double t201 = k6*c14;
    phi[669] = t200*t95 - t201*qdd[14];
    const double t202 = t200*qdd[14] + t201*t95;
    phi[670] = t202;
    const double t203 = s15*t200 + k5*c15;
    const double t204 = k5*s15 - c15*t200;
    const double t205 = t203*t101 + t204*t105 - t201*t108;
    phi[676] = -t205;
    const double t206 = t203*t110 - t204*t111 + t201*t115;
    phi[677] = -t206;
    phi[678] = -t205;
    phi[679] = -t202;
    phi[680] = t206;
    const double t207 = k8*s17;
    const double t208 = k8*c17;
    phi[682] = t207*t118 - t208*qdd[17];
    const double t209 = t207*qdd[17] + t208*t118;
    phi[683] = t209;
    const double t210 = s18*t207 + k7*c18;
    const double t211 = k7*s18 - c18*t207;
    const double t212 = t210*t124 + t211*t128 - t208*t131;
    phi[689] = -t212;
    const double t213 = t210*t133 - t211*t134 + t208*t138;
    phi[690] = -t213;
    phi[691] = -t212;
    phi[692] = -t209;
    phi[693] = t213;
    const double t214 = k10*s20;
    const double t215 = k10*c20;
    phi[695] = t214*t141 - t215*qdd[20];
    const double t216 = t214*qdd[20] + t215*t141;
    phi[696] = t216;
    const double t217 = s21*t214 + k9*c21;
    const double t218 = k9*s21 - c21*t214;
    const double t219 = t217*t147 + t218*t151 - t215*t154;
    phi[702] = -t219;
    const double t220 = t217*t156 - t218*t157 + t215*t161;
    phi[703] = -t220;
    phi[704] = -t219;
    phi[705] = -t216;
    phi[706] = t220;
    const double t221 = k12*s23;
    const double t222 = k12*c23;
    phi[708] = t221*t164 - t222*qdd[23];
    const double t223 = t221*qdd[23] + t222*t164;
    phi[709] = t223;
    const double t224 = s24*t221 + k11*c24;
    const double t225 = k11*s24 - c24*t221;
    const double t226 = t224*t170 + t225*t174 - t222*t177;
    phi[715] = -t226;
    const double t227 = t224*t179 - t225*t180 + t222*t184;
    phi[716] = -t227;
    phi[717] = -t226;
    phi[718] = -t223;
    phi[719] = t227;
    phi[732] = qdd[8];
    const double t228 = k1*qdd[6] + k2*qdd[7];
    const double t229 = evra_geo_g*s8 - c8*t228;
    phi[733] = t229;
    const double t230 = s8*t228 + evra_geo_g*c8;
    phi[734] = t230;
    phi[735] = c9*t68 - s9*t60;
    phi[736] = s9*t69 - c9*t62;
    phi[737] = c9*t59 + s9*(t49 - t55);
    phi[738] = c9*(t49 - t65) - s9*t64;
    phi[740] = -s9*t229;
    phi[741] = -c9*t229;
    const double t231 = t229 - q[10]*t69 + qd[10]*t57*2.0;
    const double t232 = c9*q[10];
    phi[742] = -(s9*t231 + t62*t232);
    const double t233 = k1*qdd[7] - k2*qdd[6];
    const double t234 = s9*t233 - c9*t230;
    const double t235 = t234 - q[10]*t65 + qdd[10];
    const double t236 = s9*t230 + c9*t233;
    const double t237 = q[10]*t64;
    const double t238 = t236 + t237 + qd[9]*qd[10]*2.0;
    phi[743] = c9*t235 - s9*t238 + t49*t232;
    phi[744] = c9*t231 - t69*t232;
    phi[825] = t58;
    phi[826] = t65 - t55;
    phi[827] = t67;
    phi[828] = -t61;
    phi[829] = qdd[9];
    phi[830] = -t234;
    phi[831] = -t236;
    phi[832] = -(t235 + q[10]*t55);
    phi[833] = -q[10]*t61;
    phi[834] = t237 + t238;
    phi[922] = -t59;
    phi[923] = t67;
    phi[924] = -t65;
    phi[1015] = qdd[11];
    const double t239 = k3*qdd[6] + k4*qdd[7];
    const double t240 = evra_geo_g*s11 - c11*t239;
    phi[1016] = t240;
    const double t241 = s11*t239 + evra_geo_g*c11;
    phi[1017] = t241;
    phi[1018] = c12*t91 - s12*t83;
    phi[1019] = s12*t92 - c12*t85;
    phi[1020] = c12*t82 + s12*(t72 - t78);
    phi[1021] = c12*(t72 - t88) - s12*t87;
    phi[1023] = -s12*t240;
    phi[1024] = -c12*t240;
    const double t242 = t240 - q[13]*t92 + qd[13]*t80*2.0;
    const double t243 = c12*q[13];
    phi[1025] = -(s12*t242 + t85*t243);
    const double t244 = k3*qdd[7] - k4*qdd[6];
    const double t245 = s12*t244 - c12*t241;
    const double t246 = t245 - q[13]*t88 + qdd[13];
    const double t247 = s12*t241 + c12*t244;
    const double t248 = q[13]*t87;
    const double t249 = t247 + t248 + qd[12]*qd[13]*2.0;
    phi[1026] = c12*t246 - s12*t249 + t72*t243;
    phi[1027] = c12*t242 - t92*t243;
    phi[1108] = t81;
    phi[1109] = t88 - t78;
    phi[1110] = t90;
    phi[1111] = -t84;
    phi[1112] = qdd[12];
    phi[1113] = -t245;
    phi[1114] = -t247;
    phi[1115] = -(t246 + q[13]*t78);
    phi[1116] = -q[13]*t84;
    phi[1117] = t248 + t249;
    phi[1205] = -t82;
    phi[1206] = t90;
    phi[1207] = -t88;
    phi[1298] = qdd[14];
    const double t250 = k5*qdd[6] + k6*qdd[7];
    const double t251 = evra_geo_g*s14 - c14*t250;
    phi[1299] = t251;
    const double t252 = s14*t250 + evra_geo_g*c14;
    phi[1300] = t252;
    phi[1301] = c15*t114 - s15*t106;
    phi[1302] = s15*t115 - c15*t108;
    phi[1303] = c15*t105 + s15*(t95 - t101);
    phi[1304] = c15*(t95 - t111) - s15*t110;
    phi[1306] = -s15*t251;
    phi[1307] = -c15*t251;
    const double t253 = t251 - q[16]*t115 + qd[16]*t103*2.0;
    const double t254 = c15*q[16];
    phi[1308] = -(s15*t253 + t108*t254);
    const double t255 = k5*qdd[7] - k6*qdd[6];
    const double t256 = s15*t255 - c15*t252;
    const double t257 = t256 - q[16]*t111 + qdd[16];
    const double t258 = s15*t252 + c15*t255;
    const double t259 = q[16]*t110;
    const double t260 = t258 + t259 + qd[15]*qd[16]*2.0;
    phi[1309] = c15*t257 - s15*t260 + t95*t254;
    phi[1310] = c15*t253 - t115*t254;
    phi[1391] = t104;
    phi[1392] = t111 - t101;
    phi[1393] = t113;
    phi[1394] = -t107;
    phi[1395] = qdd[15];
    phi[1396] = -t256;
    phi[1397] = -t258;
    phi[1398] = -(t257 + q[16]*t101);
    phi[1399] = -q[16]*t107;
    phi[1400] = t259 + t260;
    phi[1488] = -t105;
    phi[1489] = t113;
    phi[1490] = -t111;
    phi[1581] = qdd[17];
    const double t261 = k7*qdd[6] + k8*qdd[7];
    const double t262 = evra_geo_g*s17 - c17*t261;
    phi[1582] = t262;
    const double t263 = s17*t261 + evra_geo_g*c17;
    phi[1583] = t263;
    phi[1584] = c18*t137 - s18*t129;
    phi[1585] = s18*t138 - c18*t131;
    phi[1586] = c18*t128 + s18*(t118 - t124);
    phi[1587] = c18*(t118 - t134) - s18*t133;
    phi[1589] = -s18*t262;
    phi[1590] = -c18*t262;
    const double t264 = t262 - q[19]*t138 + qd[19]*t126*2.0;
    const double t265 = c18*q[19];
    phi[1591] = -(s18*t264 + t131*t265);
    const double t266 = k7*qdd[7] - k8*qdd[6];
    const double t267 = s18*t266 - c18*t263;
    const double t268 = t267 - q[19]*t134 + qdd[19];
    const double t269 = s18*t263 + c18*t266;
    const double t270 = q[19]*t133;
    const double t271 = t269 + t270 + qd[18]*qd[19]*2.0;
    phi[1592] = c18*t268 - s18*t271 + t118*t265;
    phi[1593] = c18*t264 - t138*t265;
    phi[1674] = t127;
    phi[1675] = t134 - t124;
    phi[1676] = t136;
    phi[1677] = -t130;
    phi[1678] = qdd[18];
    phi[1679] = -t267;
    phi[1680] = -t269;
    phi[1681] = -(t268 + q[19]*t124);
    phi[1682] = -q[19]*t130;
    phi[1683] = t270 + t271;
    phi[1771] = -t128;
    phi[1772] = t136;
    phi[1773] = -t134;
    phi[1864] = qdd[20];
    const double t272 = k9*qdd[6] + k10*qdd[7];
    const double t273 = evra_geo_g*s20 - c20*t272;
    phi[1865] = t273;
    const double t274 = s20*t272 + evra_geo_g*c20;
    phi[1866] = t274;
    phi[1867] = c21*t160 - s21*t152;
    phi[1868] = s21*t161 - c21*t154;
    phi[1869] = c21*t151 + s21*(t141 - t147);
    phi[1870] = c21*(t141 - t157) - s21*t156;
    phi[1872] = -s21*t273;
    phi[1873] = -c21*t273;
    const double t275 = t273 - q[22]*t161 + qd[22]*t149*2.0;
    const double t276 = c21*q[22];
    phi[1874] = -(s21*t275 + t154*t276);
    const double t277 = k9*qdd[7] - k10*qdd[6];
    const double t278 = s21*t277 - c21*t274;
    const double t279 = t278 - q[22]*t157 + qdd[22];
    const double t280 = s21*t274 + c21*t277;
    const double t281 = q[22]*t156;
    const double t282 = t280 + t281 + qd[21]*qd[22]*2.0;
    phi[1875] = c21*t279 - s21*t282 + t141*t276;
    phi[1876] = c21*t275 - t161*t276;
    phi[1957] = t150;
    phi[1958] = t157 - t147;
    phi[1959] = t159;
    phi[1960] = -t153;
    phi[1961] = qdd[21];
    phi[1962] = -t278;
    phi[1963] = -t280;
    phi[1964] = -(t279 + q[22]*t147);
    phi[1965] = -q[22]*t153;
    phi[1966] = t281 + t282;
    phi[2054] = -t151;
    phi[2055] = t159;
    phi[2056] = -t157;
    phi[2147] = qdd[23];
    const double t283 = k11*qdd[6] + k12*qdd[7];
    const double t284 = evra_geo_g*s23 - c23*t283;
    phi[2148] = t284;
    const double t285 = s23*t283 + evra_geo_g*c23;
    phi[2149] = t285;
    phi[2150] = c24*t183 - s24*t175;
    phi[2151] = s24*t184 - c24*t177;
    phi[2152] = c24*t174 + s24*(t164 - t170);
    phi[2153] = c24*(t164 - t180) - s24*t179;
    phi[2155] = -s24*t284;
    phi[2156] = -c24*t284;
    const double t286 = t284 - q[25]*t184 + qd[25]*t172*2.0;
    const double t287 = c24*q[25];
    phi[2157] = -(s24*t286 + t177*t287);
    const double t288 = k11*qdd[7] - k12*qdd[6];
    const double t289 = s24*t288 - c24*t285;
    const double t290 = t289 - q[25]*t180 + qdd[25];
    const double t291 = s24*t285 + c24*t288;
    const double t292 = q[25]*t179;
    const double t293 = t291 + t292 + qd[24]*qd[25]*2.0;
    phi[2158] = c24*t290 - s24*t293 + t164*t287;
    phi[2159] = c24*t286 - t184*t287;
    phi[2240] = t173;
    phi[2241] = t180 - t170;
    phi[2242] = t182;
    phi[2243] = -t176;
    phi[2244] = qdd[24];
    phi[2245] = -t289;
    phi[2246] = -t291;
    phi[2247] = -(t290 + q[25]*t170);
    phi[2248] = -q[25]*t176;
    phi[2249] = t292 + t293;
    phi[2337] = -t174;
    phi[2338] = t182;
    phi[2339] = -t180;
}
