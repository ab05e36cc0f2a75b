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
    MODELER_ALL_ZEROS(phi, 360);

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
    phi[75] = qdd[1];
    const double t1 = qd[1]*qd[1];
    phi[16] = s1*t1 - c1*qdd[1];
    const double t2 = c1*qdd[0];
    phi[76] = -t2;
    MODELER_ZEROS(phi + 0, 8);
    const double t3 = s1*qdd[1] + c1*t1;
    phi[17] = t3;
    const double t4 = s1*qdd[0];
    phi[77] = t4;
    phi[19] = qdd[0];
    const double t5 = s2*qdd[1];
    MODELER_ZEROS(phi + 8, 1);
    const double t6 = c2*qd[1];
    const double t7 = qd[2]*t6;
    const double t8 = t5 + t7;
    const double t9 = s2*qd[1];
    const double t10 = qd[2]*t9;
    const double t11 = c2*t10;
    MODELER_ZEROS(phi + 10, 6);
    phi[80] = s2*t8 + t11;
    const double t12 = t9*t6;
    phi[140] = -t12;
    const double t13 = c2*qdd[1];
    const double t14 = t13 - t10;
    const double t15 = t10 - t14;
    MODELER_ZEROS(phi + 18, 1);
    const double t16 = t7 + t8;
    phi[81] = c2*t16 - s2*t15;
    const double t17 = qd[2]*qd[2];
    const double t18 = t6*t6 + t17;
    const double t19 = t9*t9 + t17;
    phi[141] = t19 - t18;
    MODELER_ZEROS(phi + 20, 6);
    const double t20 = qdd[2] + t12;
    phi[82] = c2*(t1 - t18) - s2*t20;
    phi[142] = -t5;
    phi[83] = c2*t14 - t11;
    phi[143] = t12;
    const double t21 = qdd[2] - t12;
    MODELER_ZEROS(phi + 30, 6);
    phi[84] = -(s2*(t1 - t19) + c2*t21);
    phi[144] = -t13;
    phi[145] = qdd[2];
    const double t22 = s1*c2;
    const double t23 = s1*s2;
    phi[26] = t18*t22 + t20*t23 + c1*t15;
    MODELER_ZEROS(phi + 40, 6);
    phi[86] = -c2*t2;
    const double t24 = orthoglide_leg_tree_geo_g*c2 + s2*t4;
    phi[146] = t24;
    phi[27] = t21*t22 - t19*t23 + c1*t16;
    phi[87] = s2*t2;
    const double t25 = c2*t4 - orthoglide_leg_tree_geo_g*s2;
    MODELER_ZEROS(phi + 50, 6);
    phi[147] = t25;
    phi[28] = t3;
    phi[88] = t4;
    phi[29] = qdd[0];
    const double t26 = c3*t6 - s3*t9;
    const double t27 = c3*t8 + s3*t14 + qd[3]*t26;
    MODELER_ZEROS(phi + 60, 8);
    const double t28 = s2*c3 + c2*s3;
    const double t29 = c3*t9 + s3*t6;
    const double t30 = qd[2] + qd[3];
    const double t31 = t29*t30;
    const double t32 = c2*c3 - s2*s3;
    const double t33 = t31*t32;
    MODELER_ZEROS(phi + 68, 7);
    phi[90] = t27*t28 + t33;
    const double t34 = t29*t26;
    phi[150] = -t34;
    phi[210] = -t34;
    const double t35 = c3*t14 - s3*t8 - qd[3]*t29;
    const double t36 = t35 - t31;
    MODELER_ZEROS(phi + 78, 2);
    const double t37 = t26*t30;
    const double t38 = t27 + t37;
    phi[91] = t36*t28 + t38*t32;
    const double t39 = t30*t30;
    const double t40 = t26*t26 + t39;
    const double t41 = t29*t29 + t39;
    MODELER_ZEROS(phi + 85, 1);
    const double t42 = t40 - t41;
    phi[151] = -t42;
    phi[211] = -t42;
    const double t43 = qdd[2] + qdd[3];
    const double t44 = t43 + t34;
    phi[92] = t32*(t1 - t40) - t44*t28;
    MODELER_ZEROS(phi + 89, 1);
    const double t45 = t27 - t37;
    phi[152] = -t45;
    phi[212] = -t45;
    phi[93] = t35*t32 - t33;
    phi[153] = t34;
    phi[213] = t34;
    MODELER_ZEROS(phi + 95, 1);
    const double t46 = t43 - t34;
    phi[94] = -(t28*(t1 - t41) + t46*t32);
    const double t47 = t35 + t31;
    phi[154] = -t47;
    phi[214] = -t47;
    phi[155] = t43;
    MODELER_ZEROS(phi + 115, 1);
    phi[215] = t43;
    const double t48 = c3*t22 - s3*t23;
    const double t49 = c3*t23 + s3*t22;
    phi[36] = t40*t48 + t44*t49 - c1*t36;
    const double t50 = t2 + orthoglide_leg_tree_geo_D4*t15;
    const double t51 = orthoglide_leg_tree_geo_D4*c2;
    MODELER_ZEROS(phi + 119, 8);
    phi[96] = t36*t51 - t50*t32;
    const double t52 = t24 + orthoglide_leg_tree_geo_D4*t20;
    const double t53 = t25 + orthoglide_leg_tree_geo_D4*t18;
    const double t54 = c3*t52 + s3*t53;
    const double t55 = orthoglide_leg_tree_geo_D4*s3;
    const double t56 = orthoglide_leg_tree_geo_D4*c3;
    MODELER_ZEROS(phi + 127, 8);
    phi[156] = t44*t56 - t40*t55 + t54;
    phi[216] = t54;
    const double t57 = t46*t48 - t41*t49 + c1*t38;
    phi[37] = t57;
    const double t58 = t50*t28 - t38*t51;
    phi[97] = t58;
    MODELER_ZEROS(phi + 135, 5);
    const double t59 = c3*t53 - s3*t52;
    const double t60 = t59 - (t46*t55 + t41*t56);
    phi[157] = t60;
    phi[217] = t59;
    phi[38] = t3;
    phi[98] = t54*t28 + t59*t32 - t1*t51;
    MODELER_ZEROS(phi + 148, 2);
    phi[158] = t45*t56 - t47*t55;
    const double t61 = t59*t48 + t54*t49 + c1*t50;
    phi[39] = t61;
    const double t62 = t50*t51;
    phi[99] = -t62;
    const double t63 = t59*t55 - t54*t56;
    MODELER_ZEROS(phi + 170, 8);
    phi[159] = -t63;
    const double t64 = c4*t30 + s4*t29;
    const double t65 = c4*t27 - s4*t43 - qd[4]*t64;
    const double t66 = c4*t28;
    const double t67 = c4*t29 - s4*t30;
    const double t68 = qd[4] + t26;
    MODELER_ZEROS(phi + 178, 8);
    const double t69 = t67*t68;
    const double t70 = s4*t28;
    const double t71 = t69*t70;
    const double t72 = t67*t64;
    const double t73 = t72*t32;
    phi[100] = t65*t66 - t71 + t73;
    MODELER_ZEROS(phi + 186, 8);
    const double t74 = c4*t69;
    const double t75 = s4*t65 + t74;
    phi[160] = -t75;
    phi[220] = -t75;
    phi[280] = t72;
    const double t76 = c4*t43 + s4*t27 + qd[4]*t67;
    MODELER_ZEROS(phi + 194, 8);
    const double t77 = t76 + t69;
    const double t78 = t64*t68;
    const double t79 = t65 - t78;
    const double t80 = t68*t68;
    const double t81 = t64*t64 + t80;
    const double t82 = t67*t67 + t80;
    MODELER_ZEROS(phi + 202, 8);
    const double t83 = t81 - t82;
    phi[101] = -(t77*t66 + t79*t70 + t32*t83);
    const double t84 = s4*t77 - c4*t79;
    phi[161] = t84;
    phi[221] = t84;
    phi[281] = -t83;
    MODELER_ZEROS(phi + 218, 2);
    const double t85 = qdd[4] + t35;
    const double t86 = t85 - t72;
    const double t87 = t41 - t81;
    const double t88 = t65 + t78;
    phi[102] = -(t86*t66 + t70*t87 + t88*t32);
    const double t89 = s4*t86 - c4*t87;
    MODELER_ZEROS(phi + 229, 8);
    phi[162] = t89;
    phi[222] = t89;
    phi[282] = -t88;
    const double t90 = t78*t66;
    phi[103] = t90 + t76*t70 - t73;
    const double t91 = s4*t78;
    MODELER_ZEROS(phi + 237, 8);
    const double t92 = t91 - c4*t76;
    phi[163] = -t92;
    phi[223] = -t92;
    phi[283] = -t72;
    const double t93 = t41 - t82;
    const double t94 = t85 + t72;
    MODELER_ZEROS(phi + 245, 8);
    const double t95 = t76 - t69;
    phi[104] = t95*t32 - (t66*t93 - t94*t70);
    const double t96 = s4*t93 + c4*t94;
    phi[164] = t96;
    phi[224] = t96;
    phi[284] = t95;
    MODELER_ZEROS(phi + 253, 8);
    phi[105] = t71 - t90 + t85*t32;
    const double t97 = t74 + t91;
    phi[165] = t97;
    phi[225] = t97;
    phi[285] = t85;
    const double t98 = c4*t48 + c1*s4;
    MODELER_ZEROS(phi + 261, 8);
    const double t99 = c1*c4 - s4*t48;
    phi[46] = t81*t98 - t86*t99 + t77*t49;
    const double t100 = c4*t50 - s4*t59;
    const double t101 = s4*t51;
    const double t102 = c4*t51;
    phi[106] = t54*t70 - t100*t32 + (t86*t102 - t81*t101);
    MODELER_ZEROS(phi + 269, 8);
    const double t103 = c4*t54;
    const double t104 = c4*t55;
    const double t105 = s4*t55;
    phi[166] = t77*t56 - (t81*t104 + t86*t105) + t103;
    phi[226] = t103;
    phi[286] = -t100;
    MODELER_ZEROS(phi + 277, 3);
    phi[47] = t94*t98 + t82*t99 + t79*t49;
    const double t106 = c4*t59 + s4*t50;
    phi[107] = t54*t66 + t106*t32 - (t94*t101 + t82*t102);
    const double t107 = s4*t54;
    phi[167] = -(t94*t104 - t82*t105 - t79*t56 + t107);
    phi[227] = -t107;
    MODELER_ZEROS(phi + 288, 8);
    phi[287] = t106;
    phi[48] = -t57;
    phi[108] = -t58;
    phi[168] = -t60;
    phi[228] = -t59;
    phi[49] = t61;
    MODELER_ZEROS(phi + 296, 8);
    phi[109] = -t62;
    phi[169] = -t63;
    const double t108 = s5*qdd[1];
    const double t109 = c5*qd[1];
    const double t110 = qd[5]*t109;
    const double t111 = t108 + t110;
    MODELER_ZEROS(phi + 304, 8);
    const double t112 = s5*qd[1];
    const double t113 = qd[5]*t112;
    const double t114 = c5*t113;
    phi[110] = s5*t111 + t114;
    const double t115 = t112*t109;
    phi[350] = -t115;
    MODELER_ZEROS(phi + 312, 8);
    const double t116 = c5*qdd[1];
    const double t117 = t116 - t113;
    const double t118 = t113 - t117;
    const double t119 = t110 + t111;
    phi[111] = c5*t119 - s5*t118;
    const double t120 = qd[5]*qd[5];
    MODELER_ZEROS(phi + 320, 8);
    const double t121 = t109*t109 + t120;
    const double t122 = t112*t112 + t120;
    phi[351] = t122 - t121;
    const double t123 = qdd[5] + t115;
    phi[112] = c5*(t1 - t121) - s5*t123;
    phi[352] = -t108;
    MODELER_ZEROS(phi + 328, 8);
    phi[113] = c5*t117 - t114;
    phi[353] = t115;
    const double t124 = qdd[5] - t115;
    phi[114] = -(s5*(t1 - t122) + c5*t124);
    phi[354] = -t116;
    phi[355] = qdd[5];
    MODELER_ZEROS(phi + 336, 8);
    const double t125 = s1*c5;
    const double t126 = s1*s5;
    phi[56] = t121*t125 + t123*t126 + c1*t118;
    phi[116] = -c5*t2;
    phi[356] = orthoglide_leg_tree_geo_g*c5 + s5*t4;
    phi[57] = t124*t125 - t122*t126 + c1*t119;
    MODELER_ZEROS(phi + 344, 6);
    phi[117] = s5*t2;
    phi[357] = c5*t4 - orthoglide_leg_tree_geo_g*s5;
    phi[58] = t3;
    phi[118] = t4;
    phi[59] = qdd[0];
    MODELER_ZEROS(phi + 358, 2);
}
