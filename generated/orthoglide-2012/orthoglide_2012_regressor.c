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
    const double t1 = qd[6]*qd[6];
    const double t2 = s6*t1 - c6*qdd[6];
    phi[634] = t2;
    const double t3 = s6*qdd[6] + c6*t1;
    phi[635] = t3;
    phi[637] = qdd[3];
    const double t4 = s6*c7;
    const double t5 = c7*qd[6];
    const double t6 = qd[7]*qd[7];
    const double t7 = t5*t5 + t6;
    const double t8 = s6*s7;
    const double t9 = s7*qd[6];
    const double t10 = t9*t5;
    const double t11 = qdd[7] + t10;
    const double t12 = qd[7]*t9;
    const double t13 = c7*qdd[6];
    const double t14 = t13 - t12;
    const double t15 = t12 - t14;
    phi[647] = t4*t7 + t8*t11 + c6*t15;
    const double t16 = qdd[7] - t10;
    const double t17 = t9*t9 + t6;
    const double t18 = qd[7]*t5;
    const double t19 = s7*qdd[6];
    const double t20 = t19 + t18;
    const double t21 = t18 + t20;
    phi[648] = t4*t16 - t8*t17 + c6*t21;
    phi[649] = t3;
    phi[650] = qdd[3];
    phi[660] = t2;
    phi[662] = t3;
    const double t22 = c6*qdd[3];
    const double t23 = t22 + orthoglide_2012_geo_d4*t15;
    const double t24 = s6*qdd[3];
    const double t25 = c7*t24 - orthoglide_2012_geo_g*s7;
    const double t26 = t25 + orthoglide_2012_geo_d4*t7;
    const double t27 = orthoglide_2012_geo_g*c7 + s7*t24;
    const double t28 = t27 + orthoglide_2012_geo_d4*t11;
    const double t29 = c7*t26 + s7*t28;
    const double t30 = c6*t23 + s6*t29;
    phi[663] = t30;
    phi[676] = t30;
    phi[807] = qdd[4];
    phi[808] = qdd[4];
    phi[809] = qd[4];
    phi[810] = (double)((qd[4] > 0.0) - (qd[4] < 0.0));
    const double t31 = qd[8]*qd[8];
    const double t32 = s8*t31 - c8*qdd[8];
    phi[882] = t32;
    const double t33 = s8*qdd[8] + c8*t31;
    phi[883] = t33;
    phi[885] = qdd[4];
    const double t34 = s8*c9;
    const double t35 = c9*qd[8];
    const double t36 = qd[9]*qd[9];
    const double t37 = t35*t35 + t36;
    const double t38 = s8*s9;
    const double t39 = s9*qd[8];
    const double t40 = t39*t35;
    const double t41 = qdd[9] + t40;
    const double t42 = qd[9]*t39;
    const double t43 = c9*qdd[8];
    const double t44 = t43 - t42;
    const double t45 = t42 - t44;
    phi[895] = t34*t37 + t38*t41 + c8*t45;
    const double t46 = qdd[9] - t40;
    const double t47 = t39*t39 + t36;
    const double t48 = qd[9]*t35;
    const double t49 = s9*qdd[8];
    const double t50 = t49 + t48;
    const double t51 = t48 + t50;
    phi[896] = t34*t46 - t38*t47 + c8*t51;
    phi[897] = t33;
    phi[898] = qdd[4];
    phi[908] = t32;
    phi[910] = t33;
    const double t52 = c8*qdd[4] - orthoglide_2012_geo_g*s8;
    const double t53 = t52 + orthoglide_2012_geo_d4*t45;
    const double t54 = orthoglide_2012_geo_g*c8 + s8*qdd[4];
    const double t55 = c9*t54;
    const double t56 = t55 + orthoglide_2012_geo_d4*t37;
    const double t57 = s9*t54;
    const double t58 = t57 + orthoglide_2012_geo_d4*t41;
    const double t59 = c9*t56 + s9*t58;
    const double t60 = c8*t53 + s8*t59;
    phi[911] = t60;
    phi[924] = t60;
    const double t61 = qdd[5] - orthoglide_2012_geo_g;
    phi[1016] = t61;
    phi[1017] = qdd[5];
    phi[1018] = qd[5];
    phi[1019] = (double)((qd[5] > 0.0) - (qd[5] < 0.0));
    const double t62 = qd[10]*qd[10];
    const double t63 = s10*t62 - c10*qdd[10];
    phi[1130] = t63;
    const double t64 = s10*qdd[10] + c10*t62;
    phi[1131] = t64;
    phi[1133] = t61;
    const double t65 = s10*c11;
    const double t66 = c11*qd[10];
    const double t67 = qd[11]*qd[11];
    const double t68 = t66*t66 + t67;
    const double t69 = s10*s11;
    const double t70 = s11*qd[10];
    const double t71 = t70*t66;
    const double t72 = qdd[11] + t71;
    const double t73 = qd[11]*t70;
    const double t74 = c11*qdd[10];
    const double t75 = t74 - t73;
    const double t76 = t73 - t75;
    phi[1143] = t65*t68 + t69*t72 + c10*t76;
    const double t77 = qdd[11] - t71;
    const double t78 = t70*t70 + t67;
    const double t79 = qd[11]*t66;
    const double t80 = s11*qdd[10];
    const double t81 = t80 + t79;
    const double t82 = t79 + t81;
    phi[1144] = t65*t77 - t69*t78 + c10*t82;
    phi[1145] = t64;
    phi[1146] = t61;
    phi[1156] = t63;
    phi[1158] = t64;
    const double t83 = c10*t61;
    const double t84 = t83 + orthoglide_2012_geo_d4*t76;
    const double t85 = s10*t61;
    const double t86 = c11*t85;
    const double t87 = t86 + orthoglide_2012_geo_d4*t68;
    const double t88 = s11*t85;
    const double t89 = t88 + orthoglide_2012_geo_d4*t72;
    const double t90 = c11*t87 + s11*t89;
    const double t91 = c10*t84 + s10*t90;
    phi[1159] = t91;
    phi[1172] = t91;
    phi[1221] = qdd[6];
    phi[1222] = -t22;
    phi[1223] = t24;
    phi[1226] = qdd[6];
    phi[1227] = qd[6];
    const double t92 = (double)((qd[6] > 0.0) - (qd[6] < 0.0));
    phi[1228] = t92;
    const double t93 = c7*t12;
    phi[1229] = s7*t20 + t93;
    phi[1230] = c7*t21 - s7*t15;
    phi[1231] = c7*(t1 - t7) - s7*t11;
    phi[1232] = c7*t14 - t93;
    phi[1233] = -(s7*(t1 - t17) + c7*t16);
    phi[1235] = -c7*t22;
    phi[1236] = s7*t22;
    phi[1237] = t24;
    phi[1245] = qdd[6];
    const double t94 = orthoglide_2012_geo_d4*c7;
    phi[1248] = t94*qdd[6] - t23;
    phi[1250] = t29 - t94*t1;
    const double t95 = t94*t23;
    phi[1251] = -t95;
    phi[1264] = -t95;
    phi[1265] = qdd[6];
    phi[1266] = qd[6];
    phi[1267] = t92;
    phi[1425] = -t10;
    phi[1426] = t17 - t7;
    phi[1427] = -t19;
    phi[1428] = t10;
    phi[1429] = -t13;
    phi[1430] = qdd[7];
    phi[1431] = t27;
    phi[1432] = t25;
    phi[1435] = qdd[7];
    phi[1436] = qd[7];
    const double t96 = (double)((qd[7] > 0.0) - (qd[7] < 0.0));
    phi[1437] = t96;
    const double t97 = orthoglide_2012_geo_d4*s7;
    phi[1444] = t97*t1;
    phi[1446] = t97*qdd[6];
    const double t98 = t97*t29 + t94*(c7*t28 - s7*t26);
    phi[1447] = t98;
    phi[1448] = qdd[7];
    phi[1449] = qd[7];
    phi[1450] = t96;
    phi[1460] = t98;
    phi[1665] = qdd[8];
    phi[1666] = -t52;
    phi[1667] = t54;
    phi[1670] = qdd[8];
    phi[1671] = qd[8];
    const double t99 = (double)((qd[8] > 0.0) - (qd[8] < 0.0));
    phi[1672] = t99;
    const double t100 = c9*t42;
    phi[1673] = s9*t50 + t100;
    phi[1674] = c9*t51 - s9*t45;
    phi[1675] = c9*(t31 - t37) - s9*t41;
    phi[1676] = c9*t44 - t100;
    phi[1677] = -(s9*(t31 - t47) + c9*t46);
    phi[1679] = -c9*t52;
    phi[1680] = s9*t52;
    phi[1681] = t54;
    phi[1689] = qdd[8];
    const double t101 = orthoglide_2012_geo_d4*c9;
    phi[1692] = t101*qdd[8] - t53;
    phi[1694] = t59 - t101*t31;
    const double t102 = t101*t53;
    phi[1695] = -t102;
    phi[1708] = -t102;
    phi[1709] = qdd[8];
    phi[1710] = qd[8];
    phi[1711] = t99;
    phi[1869] = -t40;
    phi[1870] = t47 - t37;
    phi[1871] = -t49;
    phi[1872] = t40;
    phi[1873] = -t43;
    phi[1874] = qdd[9];
    phi[1875] = t57;
    phi[1876] = t55;
    phi[1879] = qdd[9];
    phi[1880] = qd[9];
    const double t103 = (double)((qd[9] > 0.0) - (qd[9] < 0.0));
    phi[1881] = t103;
    const double t104 = orthoglide_2012_geo_d4*s9;
    phi[1888] = t104*t31;
    phi[1890] = t104*qdd[8];
    const double t105 = t104*t59 + t101*(c9*t58 - s9*t56);
    phi[1891] = t105;
    phi[1892] = qdd[9];
    phi[1893] = qd[9];
    phi[1894] = t103;
    phi[1904] = t105;
    phi[2109] = qdd[10];
    phi[2110] = -t83;
    phi[2111] = t85;
    phi[2114] = qdd[10];
    phi[2115] = qd[10];
    const double t106 = (double)((qd[10] > 0.0) - (qd[10] < 0.0));
    phi[2116] = t106;
    const double t107 = c11*t73;
    phi[2117] = s11*t81 + t107;
    phi[2118] = c11*t82 - s11*t76;
    phi[2119] = c11*(t62 - t68) - s11*t72;
    phi[2120] = c11*t75 - t107;
    phi[2121] = -(s11*(t62 - t78) + c11*t77);
    phi[2123] = -c11*t83;
    phi[2124] = s11*t83;
    phi[2125] = t85;
    phi[2133] = qdd[10];
    const double t108 = orthoglide_2012_geo_d4*c11;
    phi[2136] = t108*qdd[10] - t84;
    phi[2138] = t90 - t108*t62;
    const double t109 = t108*t84;
    phi[2139] = -t109;
    phi[2152] = -t109;
    phi[2153] = qdd[10];
    phi[2154] = qd[10];
    phi[2155] = t106;
    phi[2313] = -t71;
    phi[2314] = t78 - t68;
    phi[2315] = -t80;
    phi[2316] = t71;
    phi[2317] = -t74;
    phi[2318] = qdd[11];
    phi[2319] = t88;
    phi[2320] = t86;
    phi[2323] = qdd[11];
    phi[2324] = qd[11];
    const double t110 = (double)((qd[11] > 0.0) - (qd[11] < 0.0));
    phi[2325] = t110;
    const double t111 = orthoglide_2012_geo_d4*s11;
    phi[2332] = t111*t62;
    phi[2334] = t111*qdd[10];
    const double t112 = t111*t90 + t108*(c11*t89 - s11*t87);
    phi[2335] = t112;
    phi[2336] = qdd[11];
    phi[2337] = qd[11];
    phi[2338] = t110;
    phi[2348] = t112;
}
