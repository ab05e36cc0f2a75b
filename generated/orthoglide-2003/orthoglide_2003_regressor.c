/* Orthoglide, three translations (Guegan, Khalil, Lemoine 2003)
 *
 * Functions of orthoglide_2003.h.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#include "orthoglide_2003.h"

#include <math.h>

#include "modeler_runtime.h"
#include "modeler_sincos.h"
#include "orthoglide_2003_tree.h"

/* Geometry. To use another value, compile with e.g. -DORTHOGLIDE_2003_GEO_g=9.81
 * or any constant expression of C; mind that 1/2 is 0 there, 1.0/2 is not. */
#ifndef ORTHOGLIDE_2003_GEO_g
#define ORTHOGLIDE_2003_GEO_g 9.81
#endif
#ifndef ORTHOGLIDE_2003_GEO_D41
#define ORTHOGLIDE_2003_GEO_D41 0.31
#endif
#ifndef ORTHOGLIDE_2003_GEO_D42
#define ORTHOGLIDE_2003_GEO_D42 0.31
#endif
#ifndef ORTHOGLIDE_2003_GEO_D43
#define ORTHOGLIDE_2003_GEO_D43 0.31
#endif
#ifndef ORTHOGLIDE_2003_GEO_b3
#define ORTHOGLIDE_2003_GEO_b3 (-0.04)
#endif
#ifndef ORTHOGLIDE_2003_GEO_b7
#define ORTHOGLIDE_2003_GEO_b7 0.04
#endif
#ifndef ORTHOGLIDE_2003_GEO_a
#define ORTHOGLIDE_2003_GEO_a 0.6
#endif
#ifndef ORTHOGLIDE_2003_GEO_d6
#define ORTHOGLIDE_2003_GEO_d6 0.1
#endif

static const double orthoglide_2003_geo_g = ORTHOGLIDE_2003_GEO_g;
static const double orthoglide_2003_geo_D41 = ORTHOGLIDE_2003_GEO_D41;
static const double orthoglide_2003_geo_D42 = ORTHOGLIDE_2003_GEO_D42;
static const double orthoglide_2003_geo_D43 = ORTHOGLIDE_2003_GEO_D43;

/* Regressor of the standard parameters.
 * 99 additions, 172 multiplications. */
void orthoglide_2003_tree_regressor(const double *q, const double *qd, const double *qdd,
                                    double *MODELER_RESTRICT phi)
{
    for (int i = 0; i < 1956; i++)
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
    phi[163] = qdd[1] - orthoglide_2003_geo_g;
    phi[326] = qdd[2];
    phi[499] = qdd[3];
    phi[500] = qdd[3];
    phi[501] = qd[3];
    phi[502] = (double)((qd[3] > 0.0) - (qd[3] < 0.0));
    phi[503] = 1.0;
    const double t1 = qd[6]*qd[6];
    const double t2 = s6*t1 - c6*qdd[6];
    phi[538] = t2;
    const double t3 = s6*qdd[6] + c6*t1;
    phi[539] = t3;
    phi[541] = qdd[3];
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
    const double t16 = t4*t7 + t8*t11 + c6*t15;
    phi[548] = t16;
    const double t17 = qdd[7] - t10;
    const double t18 = t9*t9 + t6;
    const double t19 = qd[7]*t5;
    const double t20 = s7*qdd[6];
    const double t21 = t20 + t19;
    const double t22 = t19 + t21;
    const double t23 = t4*t17 - t8*t18 + c6*t22;
    phi[549] = t23;
    phi[550] = t3;
    phi[551] = qdd[3];
    phi[558] = t2;
    phi[560] = t3;
    const double t24 = s6*qdd[3];
    const double t25 = c7*t24 - orthoglide_2003_geo_g*s7;
    const double t26 = t25 + orthoglide_2003_geo_D41*t7;
    const double t27 = orthoglide_2003_geo_g*c7 + s7*t24;
    const double t28 = t27 + orthoglide_2003_geo_D41*t11;
    const double t29 = c7*t26 + s7*t28;
    const double t30 = c6*qdd[3];
    const double t31 = t30 + orthoglide_2003_geo_D41*t15;
    phi[561] = s6*t29 + c6*t31;
    phi[568] = t16;
    phi[569] = t23;
    phi[570] = t3;
    phi[571] = qdd[3];
    phi[676] = qdd[4];
    phi[677] = qdd[4];
    phi[678] = qd[4];
    phi[679] = (double)((qd[4] > 0.0) - (qd[4] < 0.0));
    phi[680] = 1.0;
    const double t32 = qd[8]*qd[8];
    const double t33 = s8*t32 - c8*qdd[8];
    phi[741] = t33;
    const double t34 = s8*qdd[8] + c8*t32;
    phi[742] = t34;
    phi[744] = qdd[4];
    const double t35 = s8*c9;
    const double t36 = c9*qd[8];
    const double t37 = qd[9]*qd[9];
    const double t38 = t36*t36 + t37;
    const double t39 = s8*s9;
    const double t40 = s9*qd[8];
    const double t41 = t40*t36;
    const double t42 = qdd[9] + t41;
    const double t43 = qd[9]*t40;
    const double t44 = c9*qdd[8];
    const double t45 = t44 - t43;
    const double t46 = t43 - t45;
    const double t47 = t35*t38 + t39*t42 + c8*t46;
    phi[751] = t47;
    const double t48 = qdd[9] - t41;
    const double t49 = t40*t40 + t37;
    const double t50 = qd[9]*t36;
    const double t51 = s9*qdd[8];
    const double t52 = t51 + t50;
    const double t53 = t50 + t52;
    const double t54 = t35*t48 - t39*t49 + c8*t53;
    phi[752] = t54;
    phi[753] = t34;
    phi[754] = qdd[4];
    phi[761] = t33;
    phi[763] = t34;
    const double t55 = orthoglide_2003_geo_g*c8 + s8*qdd[4];
    const double t56 = c9*t55;
    const double t57 = t56 + orthoglide_2003_geo_D42*t38;
    const double t58 = s9*t55;
    const double t59 = t58 + orthoglide_2003_geo_D42*t42;
    const double t60 = c9*t57 + s9*t59;
    const double t61 = c8*qdd[4] - orthoglide_2003_geo_g*s8;
    const double t62 = t61 + orthoglide_2003_geo_D42*t46;
    phi[764] = s8*t60 + c8*t62;
    phi[771] = t47;
    phi[772] = t54;
    phi[773] = t34;
    phi[774] = qdd[4];
    const double t63 = qdd[5] - orthoglide_2003_geo_g;
    phi[853] = t63;
    phi[854] = qdd[5];
    phi[855] = qd[5];
    phi[856] = (double)((qd[5] > 0.0) - (qd[5] < 0.0));
    phi[857] = 1.0;
    const double t64 = qd[10]*qd[10];
    const double t65 = s10*t64 - c10*qdd[10];
    phi[944] = t65;
    const double t66 = s10*qdd[10] + c10*t64;
    phi[945] = t66;
    phi[947] = t63;
    const double t67 = s10*c11;
    const double t68 = c11*qd[10];
    const double t69 = qd[11]*qd[11];
    const double t70 = t68*t68 + t69;
    const double t71 = s10*s11;
    const double t72 = s11*qd[10];
    const double t73 = t72*t68;
    const double t74 = qdd[11] + t73;
    const double t75 = qd[11]*t72;
    const double t76 = c11*qdd[10];
    const double t77 = t76 - t75;
    const double t78 = t75 - t77;
    const double t79 = t67*t70 + t71*t74 + c10*t78;
    phi[954] = t79;
    const double t80 = qdd[11] - t73;
    const double t81 = t72*t72 + t69;
    const double t82 = qd[11]*t68;
    const double t83 = s11*qdd[10];
    const double t84 = t83 + t82;
    const double t85 = t82 + t84;
    const double t86 = t67*t80 - t71*t81 + c10*t85;
    phi[955] = t86;
    phi[956] = t66;
    phi[957] = t63;
    phi[964] = t65;
    phi[966] = t66;
    const double t87 = s10*t63;
    const double t88 = c11*t87;
    const double t89 = t88 + orthoglide_2003_geo_D43*t70;
    const double t90 = s11*t87;
    const double t91 = t90 + orthoglide_2003_geo_D43*t74;
    const double t92 = c11*t89 + s11*t91;
    const double t93 = c10*t63;
    const double t94 = t93 + orthoglide_2003_geo_D43*t78;
    phi[967] = s10*t92 + c10*t94;
    phi[974] = t79;
    phi[975] = t86;
    phi[976] = t66;
    phi[977] = t63;
    phi[1026] = qdd[6];
    phi[1027] = -t30;
    phi[1028] = t24;
    const double t95 = c7*t12;
    const double t96 = s7*t21 + t95;
    phi[1031] = t96;
    const double t97 = s7*t15 - c7*t22;
    phi[1032] = -t97;
    const double t98 = s7*t11 - c7*(t1 - t7);
    phi[1033] = -t98;
    const double t99 = c7*t14 - t95;
    phi[1034] = t99;
    const double t100 = s7*(t1 - t18) + c7*t17;
    phi[1035] = -t100;
    const double t101 = c7*t30;
    phi[1037] = -t101;
    const double t102 = s7*t30;
    phi[1038] = t102;
    phi[1039] = t24;
    phi[1044] = qdd[6];
    const double t103 = orthoglide_2003_geo_D41*c7;
    phi[1047] = t103*qdd[6] - t31;
    phi[1049] = t29 - t103*t1;
    phi[1050] = -t103*t31;
    phi[1051] = t96;
    phi[1052] = -t97;
    phi[1053] = -t98;
    phi[1054] = t99;
    phi[1055] = -t100;
    phi[1057] = -t101;
    phi[1058] = t102;
    phi[1059] = t24;
    phi[1194] = -t10;
    const double t104 = t7 - t18;
    phi[1195] = -t104;
    phi[1196] = -t20;
    phi[1197] = t10;
    phi[1198] = -t13;
    phi[1199] = qdd[7];
    phi[1200] = t27;
    phi[1201] = t25;
    const double t105 = orthoglide_2003_geo_D41*s7;
    phi[1210] = t105*t1;
    phi[1212] = t105*qdd[6];
    phi[1213] = t105*t29 + t103*(c7*t28 - s7*t26);
    phi[1214] = -t10;
    phi[1215] = -t104;
    phi[1216] = -t20;
    phi[1217] = t10;
    phi[1218] = -t13;
    phi[1219] = qdd[7];
    phi[1220] = t27;
    phi[1221] = t25;
    phi[1392] = qdd[8];
    phi[1393] = -t61;
    phi[1394] = t55;
    const double t106 = c9*t43;
    const double t107 = s9*t52 + t106;
    phi[1397] = t107;
    const double t108 = s9*t46 - c9*t53;
    phi[1398] = -t108;
    const double t109 = s9*t42 - c9*(t32 - t38);
    phi[1399] = -t109;
    const double t110 = c9*t45 - t106;
    phi[1400] = t110;
    const double t111 = s9*(t32 - t49) + c9*t48;
    phi[1401] = -t111;
    const double t112 = c9*t61;
    phi[1403] = -t112;
    const double t113 = s9*t61;
    phi[1404] = t113;
    phi[1405] = t55;
    phi[1410] = qdd[8];
    const double t114 = orthoglide_2003_geo_D42*c9;
    phi[1413] = t114*qdd[8] - t62;
    phi[1415] = t60 - t114*t32;
    phi[1416] = -t114*t62;
    phi[1417] = t107;
    phi[1418] = -t108;
    phi[1419] = -t109;
    phi[1420] = t110;
    phi[1421] = -t111;
    phi[1423] = -t112;
    phi[1424] = t113;
    phi[1425] = t55;
    phi[1560] = -t41;
    const double t115 = t38 - t49;
    phi[1561] = -t115;
    phi[1562] = -t51;
    phi[1563] = t41;
    phi[1564] = -t44;
    phi[1565] = qdd[9];
    phi[1566] = t58;
    phi[1567] = t56;
    const double t116 = orthoglide_2003_geo_D42*s9;
    phi[1576] = t116*t32;
    phi[1578] = t116*qdd[8];
    phi[1579] = t116*t60 + t114*(c9*t59 - s9*t57);
    phi[1580] = -t41;
    phi[1581] = -t115;
    phi[1582] = -t51;
    phi[1583] = t41;
    phi[1584] = -t44;
    phi[1585] = qdd[9];
    phi[1586] = t58;
    phi[1587] = t56;
    phi[1758] = qdd[10];
    phi[1759] = -t93;
    phi[1760] = t87;
    const double t117 = c11*t75;
    const double t118 = s11*t84 + t117;
    phi[1763] = t118;
    const double t119 = s11*t78 - c11*t85;
    phi[1764] = -t119;
    const double t120 = s11*t74 - c11*(t64 - t70);
    phi[1765] = -t120;
    const double t121 = c11*t77 - t117;
    phi[1766] = t121;
    const double t122 = s11*(t64 - t81) + c11*t80;
    phi[1767] = -t122;
    const double t123 = c11*t93;
    phi[1769] = -t123;
    const double t124 = s11*t93;
    phi[1770] = t124;
    phi[1771] = t87;
    phi[1776] = qdd[10];
    const double t125 = orthoglide_2003_geo_D43*c11;
    phi[1779] = t125*qdd[10] - t94;
    phi[1781] = t92 - t125*t64;
    phi[1782] = -t125*t94;
    phi[1783] = t118;
    phi[1784] = -t119;
    phi[1785] = -t120;
    phi[1786] = t121;
    phi[1787] = -t122;
    phi[1789] = -t123;
    phi[1790] = t124;
    phi[1791] = t87;
    phi[1926] = -t73;
    const double t126 = t70 - t81;
    phi[1927] = -t126;
    phi[1928] = -t83;
    phi[1929] = t73;
    phi[1930] = -t76;
    phi[1931] = qdd[11];
    phi[1932] = t90;
    phi[1933] = t88;
    const double t127 = orthoglide_2003_geo_D43*s11;
    phi[1942] = t127*t64;
    phi[1944] = t127*qdd[10];
    phi[1945] = t127*t92 + t125*(c11*t91 - s11*t89);
    phi[1946] = -t73;
    phi[1947] = -t126;
    phi[1948] = -t83;
    phi[1949] = t73;
    phi[1950] = -t76;
    phi[1951] = qdd[11];
    phi[1952] = t90;
    phi[1953] = t88;
}
