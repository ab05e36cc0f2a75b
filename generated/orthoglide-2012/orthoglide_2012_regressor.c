/* Orthoglide, full dynamic model (Briot, Gautier 2012)
 *
 * Functions of orthoglide_2012.h.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#include "orthoglide_2012.h"

#include <math.h>

#include "modeler_runtime.h"
#include "modeler_sincos.h"
#include "orthoglide_2012_tree.h"

/* Geometry. To use another value, compile with e.g. -DORTHOGLIDE_2012_GEO_g=9.81
 * or any constant expression of C; mind that 1/2 is 0 there, 1.0/2 is not. */
#ifndef ORTHOGLIDE_2012_GEO_g
#define ORTHOGLIDE_2012_GEO_g 9.81
#endif
#ifndef ORTHOGLIDE_2012_GEO_d4
#define ORTHOGLIDE_2012_GEO_d4 0.31
#endif
#ifndef ORTHOGLIDE_2012_GEO_a
#define ORTHOGLIDE_2012_GEO_a 0.6
#endif
#ifndef ORTHOGLIDE_2012_GEO_d6
#define ORTHOGLIDE_2012_GEO_d6 0.1
#endif

static const double orthoglide_2012_geo_g = ORTHOGLIDE_2012_GEO_g;
static const double orthoglide_2012_geo_d4 = ORTHOGLIDE_2012_GEO_d4;

/* Regressor of the standard parameters.
 * 99 additions, 172 multiplications. */
void orthoglide_2012_tree_regressor(const double *q, const double *qd, const double *qdd,
                                    double *MODELER_RESTRICT phi)
{
    for (int i = 0; i < 2352; i++)
        phi[i] = 0.0;

    double s6, c6;
    modeler_sincos(q[6], &s6, &c6);
    double s7, c7;
    modeler_sincos(q[7], &s7, &c7);
    double s8, c8;
    modeler_sincos(q[8], &s8, &c8);
    double s9, c9;
    modeler_sincos(q[9], &s9, &c9);
    double s10, c10;
    modeler_sincos(q[10], &s10, &c10);
    double s11, c11;
    modeler_sincos(q[11], &s11, &c11);

    phi[0] = qdd[0];
    phi[196] = qdd[1] - orthoglide_2012_geo_g;
    phi[392] = qdd[2];
    phi[598] = qdd[3];
    phi[599] = qdd[3];
    phi[600] = qd[3];
    phi[601] = (double)((qd[3] > 0.0) - (qd[3] < 0.0));
    phi[807] = qdd[4];
    phi[808] = qdd[4];
    phi[809] = qd[4];
    phi[810] = (double)((qd[4] > 0.0) - (qd[4] < 0.0));
    const double t1 = qdd[5] - orthoglide_2012_geo_g;
    phi[1016] = t1;
    phi[1017] = qdd[5];
    phi[1018] = qd[5];
    phi[1019] = (double)((qd[5] > 0.0) - (qd[5] < 0.0));
    phi[1221] = qdd[6];
    const double t2 = qd[6]*qd[6];
    const double t3 = s6*t2 - c6*qdd[6];
    phi[634] = t3;
    const double t4 = c6*qdd[3];
    phi[1222] = -t4;
    const double t5 = s6*qdd[6] + c6*t2;
    phi[635] = t5;
    const double t6 = s6*qdd[3];
    phi[1223] = t6;
    phi[637] = qdd[3];
    phi[1226] = qdd[6];
    phi[1227] = qd[6];
    const double t7 = (double)((qd[6] > 0.0) - (qd[6] < 0.0));
    phi[1228] = t7;
    const double t8 = s7*qdd[6];
    const double t9 = c7*qd[6];
    const double t10 = qd[7]*t9;
    const double t11 = t8 + t10;
    const double t12 = s7*qd[6];
    const double t13 = qd[7]*t12;
    const double t14 = c7*t13;
    phi[1229] = s7*t11 + t14;
    const double t15 = t12*t9;
    phi[1425] = -t15;
    const double t16 = c7*qdd[6];
    const double t17 = t16 - t13;
    const double t18 = t13 - t17;
    const double t19 = t10 + t11;
    phi[1230] = c7*t19 - s7*t18;
    const double t20 = qd[7]*qd[7];
    const double t21 = t9*t9 + t20;
    const double t22 = t12*t12 + t20;
    phi[1426] = t22 - t21;
    const double t23 = qdd[7] + t15;
    phi[1231] = c7*(t2 - t21) - s7*t23;
    phi[1427] = -t8;
    phi[1232] = c7*t17 - t14;
    phi[1428] = t15;
    const double t24 = qdd[7] - t15;
    phi[1233] = -(s7*(t2 - t22) + c7*t24);
    phi[1429] = -t16;
    phi[1430] = qdd[7];
    const double t25 = s6*c7;
    const double t26 = s6*s7;
    phi[647] = t25*t21 + t26*t23 + c6*t18;
    phi[1235] = -c7*t4;
    const double t27 = orthoglide_2012_geo_g*c7 + s7*t6;
    phi[1431] = t27;
    phi[648] = t25*t24 - t26*t22 + c6*t19;
    phi[1236] = s7*t4;
    const double t28 = c7*t6 - orthoglide_2012_geo_g*s7;
    phi[1432] = t28;
    phi[649] = t5;
    phi[1237] = t6;
    phi[650] = qdd[3];
    phi[1435] = qdd[7];
    phi[1436] = qd[7];
    const double t29 = (double)((qd[7] > 0.0) - (qd[7] < 0.0));
    phi[1437] = t29;
    phi[1245] = qdd[6];
    phi[660] = t3;
    const double t30 = t4 + orthoglide_2012_geo_d4*t18;
    const double t31 = orthoglide_2012_geo_d4*c7;
    phi[1248] = t31*qdd[6] - t30;
    const double t32 = orthoglide_2012_geo_d4*s7;
    phi[1444] = t32*t2;
    phi[662] = t5;
    const double t33 = t28 + orthoglide_2012_geo_d4*t21;
    const double t34 = t27 + orthoglide_2012_geo_d4*t23;
    const double t35 = c7*t33 + s7*t34;
    phi[1250] = t35 - t31*t2;
    phi[1446] = t32*qdd[6];
    const double t36 = c6*t30 + s6*t35;
    phi[663] = t36;
    const double t37 = t31*t30;
    phi[1251] = -t37;
    const double t38 = t32*t35 + t31*(c7*t34 - s7*t33);
    phi[1447] = t38;
    phi[1448] = qdd[7];
    phi[1449] = qd[7];
    phi[1450] = t29;
    phi[676] = t36;
    phi[1264] = -t37;
    phi[1460] = t38;
    phi[1265] = qdd[6];
    phi[1266] = qd[6];
    phi[1267] = t7;
    phi[1665] = qdd[8];
    const double t39 = qd[8]*qd[8];
    const double t40 = s8*t39 - c8*qdd[8];
    phi[882] = t40;
    const double t41 = c8*qdd[4] - orthoglide_2012_geo_g*s8;
    phi[1666] = -t41;
    const double t42 = s8*qdd[8] + c8*t39;
    phi[883] = t42;
    const double t43 = orthoglide_2012_geo_g*c8 + s8*qdd[4];
    phi[1667] = t43;
    phi[885] = qdd[4];
    phi[1670] = qdd[8];
    phi[1671] = qd[8];
    const double t44 = (double)((qd[8] > 0.0) - (qd[8] < 0.0));
    phi[1672] = t44;
    const double t45 = s9*qdd[8];
    const double t46 = c9*qd[8];
    const double t47 = qd[9]*t46;
    const double t48 = t45 + t47;
    const double t49 = s9*qd[8];
    const double t50 = qd[9]*t49;
    const double t51 = c9*t50;
    phi[1673] = s9*t48 + t51;
    const double t52 = t49*t46;
    phi[1869] = -t52;
    const double t53 = c9*qdd[8];
    const double t54 = t53 - t50;
    const double t55 = t50 - t54;
    const double t56 = t47 + t48;
    phi[1674] = c9*t56 - s9*t55;
    const double t57 = qd[9]*qd[9];
    const double t58 = t46*t46 + t57;
    const double t59 = t49*t49 + t57;
    phi[1870] = t59 - t58;
    const double t60 = qdd[9] + t52;
    phi[1675] = c9*(t39 - t58) - s9*t60;
    phi[1871] = -t45;
    phi[1676] = c9*t54 - t51;
    phi[1872] = t52;
    const double t61 = qdd[9] - t52;
    phi[1677] = -(s9*(t39 - t59) + c9*t61);
    phi[1873] = -t53;
    phi[1874] = qdd[9];
    const double t62 = s8*c9;
    const double t63 = s8*s9;
    phi[895] = t62*t58 + t63*t60 + c8*t55;
    phi[1679] = -c9*t41;
    const double t64 = s9*t43;
    phi[1875] = t64;
    phi[896] = t62*t61 - t63*t59 + c8*t56;
    phi[1680] = s9*t41;
    const double t65 = c9*t43;
    phi[1876] = t65;
    phi[897] = t42;
    phi[1681] = t43;
    phi[898] = qdd[4];
    phi[1879] = qdd[9];
    phi[1880] = qd[9];
    const double t66 = (double)((qd[9] > 0.0) - (qd[9] < 0.0));
    phi[1881] = t66;
    phi[1689] = qdd[8];
    phi[908] = t40;
    const double t67 = t41 + orthoglide_2012_geo_d4*t55;
    const double t68 = orthoglide_2012_geo_d4*c9;
    phi[1692] = t68*qdd[8] - t67;
    const double t69 = orthoglide_2012_geo_d4*s9;
    phi[1888] = t69*t39;
    phi[910] = t42;
    const double t70 = t65 + orthoglide_2012_geo_d4*t58;
    const double t71 = t64 + orthoglide_2012_geo_d4*t60;
    const double t72 = c9*t70 + s9*t71;
    phi[1694] = t72 - t68*t39;
    phi[1890] = t69*qdd[8];
    const double t73 = c8*t67 + s8*t72;
    phi[911] = t73;
    const double t74 = t68*t67;
    phi[1695] = -t74;
    const double t75 = t69*t72 + t68*(c9*t71 - s9*t70);
    phi[1891] = t75;
    phi[1892] = qdd[9];
    phi[1893] = qd[9];
    phi[1894] = t66;
    phi[924] = t73;
    phi[1708] = -t74;
    phi[1904] = t75;
    phi[1709] = qdd[8];
    phi[1710] = qd[8];
    phi[1711] = t44;
    phi[2109] = qdd[10];
    const double t76 = qd[10]*qd[10];
    const double t77 = s10*t76 - c10*qdd[10];
    phi[1130] = t77;
    const double t78 = c10*t1;
    phi[2110] = -t78;
    const double t79 = s10*qdd[10] + c10*t76;
    phi[1131] = t79;
    const double t80 = s10*t1;
    phi[2111] = t80;
    phi[1133] = t1;
    phi[2114] = qdd[10];
    phi[2115] = qd[10];
    const double t81 = (double)((qd[10] > 0.0) - (qd[10] < 0.0));
    phi[2116] = t81;
    const double t82 = s11*qdd[10];
    const double t83 = c11*qd[10];
    const double t84 = qd[11]*t83;
    const double t85 = t82 + t84;
    const double t86 = s11*qd[10];
    const double t87 = qd[11]*t86;
    const double t88 = c11*t87;
    phi[2117] = s11*t85 + t88;
    const double t89 = t86*t83;
    phi[2313] = -t89;
    const double t90 = c11*qdd[10];
    const double t91 = t90 - t87;
    const double t92 = t87 - t91;
    const double t93 = t84 + t85;
    phi[2118] = c11*t93 - s11*t92;
    const double t94 = qd[11]*qd[11];
    const double t95 = t83*t83 + t94;
    const double t96 = t86*t86 + t94;
    phi[2314] = t96 - t95;
    const double t97 = qdd[11] + t89;
    phi[2119] = c11*(t76 - t95) - s11*t97;
    phi[2315] = -t82;
    phi[2120] = c11*t91 - t88;
    phi[2316] = t89;
    const double t98 = qdd[11] - t89;
    phi[2121] = -(s11*(t76 - t96) + c11*t98);
    phi[2317] = -t90;
    phi[2318] = qdd[11];
    const double t99 = s10*c11;
    const double t100 = s10*s11;
    phi[1143] = t99*t95 + t100*t97 + c10*t92;
    phi[2123] = -c11*t78;
    const double t101 = s11*t80;
    phi[2319] = t101;
    phi[1144] = t99*t98 - t100*t96 + c10*t93;
    phi[2124] = s11*t78;
    const double t102 = c11*t80;
    phi[2320] = t102;
    phi[1145] = t79;
    phi[2125] = t80;
    phi[1146] = t1;
    phi[2323] = qdd[11];
    phi[2324] = qd[11];
    const double t103 = (double)((qd[11] > 0.0) - (qd[11] < 0.0));
    phi[2325] = t103;
    phi[2133] = qdd[10];
    phi[1156] = t77;
    const double t104 = t78 + orthoglide_2012_geo_d4*t92;
    const double t105 = orthoglide_2012_geo_d4*c11;
    phi[2136] = t105*qdd[10] - t104;
    const double t106 = orthoglide_2012_geo_d4*s11;
    phi[2332] = t106*t76;
    phi[1158] = t79;
    const double t107 = t102 + orthoglide_2012_geo_d4*t95;
    const double t108 = t101 + orthoglide_2012_geo_d4*t97;
    const double t109 = c11*t107 + s11*t108;
    phi[2138] = t109 - t105*t76;
    phi[2334] = t106*qdd[10];
    const double t110 = c10*t104 + s10*t109;
    phi[1159] = t110;
    const double t111 = t105*t104;
    phi[2139] = -t111;
    const double t112 = t106*t109 + t105*(c11*t108 - s11*t107);
    phi[2335] = t112;
    phi[2336] = qdd[11];
    phi[2337] = qd[11];
    phi[2338] = t103;
    phi[1172] = t110;
    phi[2152] = -t111;
    phi[2348] = t112;
    phi[2153] = qdd[10];
    phi[2154] = qd[10];
    phi[2155] = t81;
}
