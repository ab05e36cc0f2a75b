/* One leg of the Orthoglide, cut open
 *
 * Functions of orthoglide_leg_tree.h.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#include "orthoglide_leg_tree.h"

#include <math.h>

#include "modeler_runtime.h"
#include "modeler_sincos.h"

/* Geometry. To use another value, compile with e.g. -DORTHOGLIDE_LEG_TREE_GEO_g=9.81
 * or any constant expression of C; mind that 1/2 is 0 there, 1.0/2 is not. */
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

/* Regressor of the standard parameters.
 * 152 additions, 218 multiplications. */
void orthoglide_leg_tree_regressor(const double *q, const double *qd, const double *qdd,
                                   double *MODELER_RESTRICT phi)
{
    for (int i = 0; i < 360; i++)
        phi[i] = 0.0;

    double s1, c1;
    modeler_sincos(q[1], &s1, &c1);
    double s2, c2;
    modeler_sincos(q[2], &s2, &c2);
    double s3, c3;
    modeler_sincos(q[3], &s3, &c3);
    double s4, c4;
    modeler_sincos(q[4], &s4, &c4);
    double s5, c5;
    modeler_sincos(q[5], &s5, &c5);

    phi[9] = qdd[0];
    const double t1 = qd[1]*qd[1];
    phi[16] = s1*t1 - c1*qdd[1];
    const double t2 = s1*qdd[1] + c1*t1;
    phi[17] = t2;
    phi[19] = qdd[0];
    const double t3 = c2*qd[1];
    const double t4 = qd[2]*qd[2];
    const double t5 = t3*t3 + t4;
    const double t6 = s1*c2;
    const double t7 = s2*qd[1];
    const double t8 = t7*t3;
    const double t9 = qdd[2] + t8;
    const double t10 = s1*s2;
    const double t11 = qd[2]*t7;
    const double t12 = c2*qdd[1];
    const double t13 = t12 - t11;
    const double t14 = t11 - t13;
    phi[26] = t5*t6 + t9*t10 + c1*t14;
    const double t15 = qdd[2] - t8;
    const double t16 = t7*t7 + t4;
    const double t17 = qd[2]*t3;
    const double t18 = s2*qdd[1];
    const double t19 = t18 + t17;
    const double t20 = t17 + t19;
    phi[27] = t15*t6 - t16*t10 + c1*t20;
    phi[28] = t2;
    phi[29] = qdd[0];
    const double t21 = c3*t3 - s3*t7;
    const double t22 = qd[2] + qd[3];
    const double t23 = t22*t22;
    const double t24 = t21*t21 + t23;
    const double t25 = c3*t6 - s3*t10;
    const double t26 = qdd[2] + qdd[3];
    const double t27 = c3*t7 + s3*t3;
    const double t28 = t27*t21;
    const double t29 = t26 + t28;
    const double t30 = c3*t10 + s3*t6;
    const double t31 = c3*t13 - s3*t19 - qd[3]*t27;
    const double t32 = t27*t22;
    const double t33 = t31 - t32;
    phi[36] = t24*t25 + t29*t30 - c1*t33;
    const double t34 = t26 - t28;
    const double t35 = t27*t27 + t23;
    const double t36 = c3*t19 + s3*t13 + qd[3]*t21;
    const double t37 = t21*t22;
    const double t38 = t36 + t37;
    const double t39 = t34*t25 - t35*t30 + c1*t38;
    phi[37] = t39;
    phi[38] = t2;
    const double t40 = s1*qdd[0];
    const double t41 = c2*t40 - orthoglide_leg_tree_geo_g*s2;
    const double t42 = t41 + orthoglide_leg_tree_geo_D4*t5;
    const double t43 = orthoglide_leg_tree_geo_g*c2 + s2*t40;
    const double t44 = t43 + orthoglide_leg_tree_geo_D4*t9;
    const double t45 = c3*t42 - s3*t44;
    const double t46 = c3*t44 + s3*t42;
    const double t47 = c1*qdd[0];
    const double t48 = t47 + orthoglide_leg_tree_geo_D4*t14;
    const double t49 = t45*t25 + t46*t30 + c1*t48;
    phi[39] = t49;
    const double t50 = c4*t22 + s4*t27;
    const double t51 = qd[4] + t21;
    const double t52 = t51*t51;
    const double t53 = t50*t50 + t52;
    const double t54 = c4*t25 + c1*s4;
    const double t55 = qdd[4] + t31;
    const double t56 = c4*t27 - s4*t22;
    const double t57 = t56*t50;
    const double t58 = t55 - t57;
    const double t59 = c1*c4 - s4*t25;
    const double t60 = c4*t26 + s4*t36 + qd[4]*t56;
    const double t61 = t56*t51;
    const double t62 = t60 + t61;
    phi[46] = t53*t54 - t58*t59 + t62*t30;
    const double t63 = t55 + t57;
    const double t64 = t56*t56 + t52;
    const double t65 = c4*t36 - s4*t26 - qd[4]*t50;
    const double t66 = t50*t51;
    const double t67 = t65 - t66;
    phi[47] = t63*t54 + t64*t59 + t67*t30;
    phi[48] = -t39;
    phi[49] = t49;
    const double t68 = c5*qd[1];
    const double t69 = qd[5]*qd[5];
    const double t70 = t68*t68 + t69;
    const double t71 = s1*c5;
    const double t72 = s5*qd[1];
    const double t73 = t72*t68;
    const double t74 = qdd[5] + t73;
    const double t75 = s1*s5;
    const double t76 = qd[5]*t72;
    const double t77 = c5*qdd[1];
    const double t78 = t77 - t76;
    const double t79 = t76 - t78;
    phi[56] = t70*t71 + t74*t75 + c1*t79;
    const double t80 = qdd[5] - t73;
    const double t81 = t72*t72 + t69;
    const double t82 = qd[5]*t68;
    const double t83 = s5*qdd[1];
    const double t84 = t83 + t82;
    const double t85 = t82 + t84;
    phi[57] = t80*t71 - t81*t75 + c1*t85;
    phi[58] = t2;
    phi[59] = qdd[0];
    phi[75] = qdd[1];
    phi[76] = -t47;
    phi[77] = t40;
    const double t86 = c2*t11;
    phi[80] = s2*t19 + t86;
    phi[81] = c2*t20 - s2*t14;
    phi[82] = c2*(t1 - t5) - s2*t9;
    phi[83] = c2*t13 - t86;
    phi[84] = -(s2*(t1 - t16) + c2*t15);
    phi[86] = -c2*t47;
    phi[87] = s2*t47;
    phi[88] = t40;
    const double t87 = s2*c3 + c2*s3;
    const double t88 = c2*c3 - s2*s3;
    const double t89 = t32*t88;
    phi[90] = t36*t87 + t89;
    phi[91] = t33*t87 + t38*t88;
    phi[92] = t88*(t1 - t24) - t29*t87;
    phi[93] = t31*t88 - t89;
    phi[94] = -(t87*(t1 - t35) + t34*t88);
    const double t90 = orthoglide_leg_tree_geo_D4*c2;
    phi[96] = t33*t90 - t48*t88;
    const double t91 = t48*t87 - t38*t90;
    phi[97] = t91;
    phi[98] = t46*t87 + t45*t88 - t1*t90;
    const double t92 = t48*t90;
    phi[99] = -t92;
    const double t93 = c4*t87;
    const double t94 = s4*t87;
    const double t95 = t61*t94;
    const double t96 = t57*t88;
    phi[100] = t65*t93 - t95 + t96;
    const double t97 = t53 - t64;
    phi[101] = -(t62*t93 + t67*t94 + t88*t97);
    const double t98 = t35 - t53;
    const double t99 = t65 + t66;
    phi[102] = -(t58*t93 + t94*t98 + t99*t88);
    const double t100 = t66*t93;
    phi[103] = t100 + t60*t94 - t96;
    const double t101 = t35 - t64;
    const double t102 = t60 - t61;
    phi[104] = t102*t88 - (t93*t101 - t63*t94);
    phi[105] = t95 - t100 + t55*t88;
    const double t103 = c4*t48 - s4*t45;
    const double t104 = s4*t90;
    const double t105 = c4*t90;
    phi[106] = t46*t94 - t103*t88 + (t58*t105 - t53*t104);
    const double t106 = c4*t45 + s4*t48;
    phi[107] = t46*t93 + t106*t88 - (t63*t104 + t64*t105);
    phi[108] = -t91;
    phi[109] = -t92;
    const double t107 = c5*t76;
    phi[110] = s5*t84 + t107;
    phi[111] = c5*t85 - s5*t79;
    phi[112] = c5*(t1 - t70) - s5*t74;
    phi[113] = c5*t78 - t107;
    phi[114] = -(s5*(t1 - t81) + c5*t80);
    phi[116] = -c5*t47;
    phi[117] = s5*t47;
    phi[118] = t40;
    phi[140] = -t8;
    phi[141] = t16 - t5;
    phi[142] = -t18;
    phi[143] = t8;
    phi[144] = -t12;
    phi[145] = qdd[2];
    phi[146] = t43;
    phi[147] = t41;
    phi[150] = -t28;
    const double t108 = t24 - t35;
    phi[151] = -t108;
    const double t109 = t36 - t37;
    phi[152] = -t109;
    phi[153] = t28;
    const double t110 = t31 + t32;
    phi[154] = -t110;
    phi[155] = t26;
    const double t111 = orthoglide_leg_tree_geo_D4*s3;
    const double t112 = orthoglide_leg_tree_geo_D4*c3;
    phi[156] = t29*t112 - t24*t111 + t46;
    const double t113 = t45 - (t34*t111 + t35*t112);
    phi[157] = t113;
    phi[158] = t109*t112 - t110*t111;
    const double t114 = t45*t111 - t46*t112;
    phi[159] = -t114;
    const double t115 = c4*t61;
    const double t116 = s4*t65 + t115;
    phi[160] = -t116;
    const double t117 = s4*t62 - c4*t67;
    phi[161] = t117;
    const double t118 = s4*t58 - c4*t98;
    phi[162] = t118;
    const double t119 = s4*t66;
    const double t120 = t119 - c4*t60;
    phi[163] = -t120;
    const double t121 = s4*t101 + c4*t63;
    phi[164] = t121;
    const double t122 = t115 + t119;
    phi[165] = t122;
    const double t123 = c4*t46;
    const double t124 = c4*t111;
    const double t125 = s4*t111;
    phi[166] = t62*t112 - (t53*t124 + t58*t125) + t123;
    const double t126 = s4*t46;
    phi[167] = -(t63*t124 - t64*t125 - t67*t112 + t126);
    phi[168] = -t113;
    phi[169] = -t114;
    phi[210] = -t28;
    phi[211] = -t108;
    phi[212] = -t109;
    phi[213] = t28;
    phi[214] = -t110;
    phi[215] = t26;
    phi[216] = t46;
    phi[217] = t45;
    phi[220] = -t116;
    phi[221] = t117;
    phi[222] = t118;
    phi[223] = -t120;
    phi[224] = t121;
    phi[225] = t122;
    phi[226] = t123;
    phi[227] = -t126;
    phi[228] = -t45;
    phi[280] = t57;
    phi[281] = -t97;
    phi[282] = -t99;
    phi[283] = -t57;
    phi[284] = t102;
    phi[285] = t55;
    phi[286] = -t103;
    phi[287] = t106;
    phi[350] = -t73;
    phi[351] = t81 - t70;
    phi[352] = -t83;
    phi[353] = t73;
    phi[354] = -t77;
    phi[355] = qdd[5];
    phi[356] = orthoglide_leg_tree_geo_g*c5 + s5*t40;
    phi[357] = c5*t40 - orthoglide_leg_tree_geo_g*s5;
}
