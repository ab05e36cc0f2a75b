"""Hidden effects of friction, with other laws than those of a model that is linear in them."""

import numpy as np

from tests.hidden_effects.effects import Draw, Hidden, effect

TANH, LUGRE, DAHL = 0.0, 1.0, 2.0  # bristle_law


def at_least(values: np.ndarray, joint: int, least: float) -> float:
    """The value of a joint, raised to what can be seen."""
    values[joint] = max(values[joint], least)
    return float(values[joint])


@effect("viscous")
def viscous(draw: Draw) -> Hidden:
    """Fv v."""
    least = 0.06 * draw.rated / draw.speed
    return Hidden(draw.joint, {"Fv": at_least(draw.plant.viscous, draw.joint, least)})


@effect("coulomb")
def coulomb(draw: Draw) -> Hidden:
    """Fc tanh(v / width)."""
    least = 0.04 * draw.rated
    return Hidden(draw.joint, {"Fc": at_least(draw.plant.coulomb, draw.joint, least)})


@effect("offset")
def offset(draw: Draw) -> Hidden:
    """A constant torque."""
    values, j = draw.plant.offset, draw.joint
    if abs(values[j]) < 0.02 * draw.rated:
        values[j] = draw.sign() * draw.between(0.02, 0.05) * draw.rated
    return Hidden(j, {"off": values[j]})


@effect("rotor_inertia")
def rotor_inertia(draw: Draw) -> Hidden:
    """Ia a, on a joint where it is no inertia of the links."""
    plant = draw.plant
    turned = abs(np.cos(plant.alpha[1])) > 1e-6  # axes 1 and 2 not perpendicular
    j = draw.pick([k for k in range(draw.n) if k >= 2 or (k == 1 and turned)])
    return Hidden(j, {"Ia": at_least(plant.rotor_inertia, j, 0.3 * draw.scales.inertia[j])})


@effect("asymmetric_viscous")
def asymmetric_viscous(draw: Draw) -> Hidden:
    """Fv v + Fa |v|."""
    j, plant = draw.joint, draw.plant
    fv = at_least(plant.viscous, j, draw.between(0.10, 0.14) * draw.rated / draw.speed)
    share = draw.sign() * draw.between(0.18, 0.35)
    plant.asymmetry[j] = share * fv
    plus, minus = fv * (1 + share), fv * (1 - share)
    return Hidden(j, {"Fv_plus": plus, "Fv_minus": minus, "Fa": plant.asymmetry[j]})


@effect("stribeck")
def stribeck(draw: Draw) -> Hidden:
    """(Fc + dF exp(-(|v| / vs)^delta)) sign(v), or LuGre with this curve."""
    j, plant = draw.joint, draw.plant
    fc = at_least(plant.coulomb, j, 0.06 * draw.rated)
    plant.stribeck_torque[j] = draw.between(0.4, 0.8) * fc
    plant.stribeck_speed[j] = draw.between(0.04, 0.15) * draw.speed
    plant.stribeck_exponent[j] = draw.rng.choice([1.0, 2.0])
    plant.coulomb_width[j] = min(plant.coulomb_width[j], plant.stribeck_speed[j] / 6)
    values = dict(
        dF=plant.stribeck_torque[j], vs=plant.stribeck_speed[j], delta=plant.stribeck_exponent[j]
    )
    if draw.rng.uniform() < 0.5:
        plant.bristle_law[j] = LUGRE
        plant.bristle_length[j] = max(6e-4, 0.5 * 0.25e-3 * draw.speed * 1.6)
        plant.bristle_damping[j] = 0.1 * plant.viscous[j]
        values["law"] = "LuGre"
    return Hidden(j, values)


@effect("nonlinear_viscous")
def nonlinear_viscous(draw: Draw) -> Hidden:
    """Fv v + Fa sign(v) |v|^p: p near 1/2, or 2 to 3."""
    j, plant = draw.joint, draw.plant
    fv = at_least(plant.viscous, j, draw.between(0.14, 0.22) * draw.rated / draw.speed)
    p = draw.between(0.35, 0.55) if draw.rng.uniform() < 0.4 else draw.between(1.8, 3.0)
    size = draw.between(0.45, 0.9) * fv * draw.speed / draw.speed**p
    if p > 1 and draw.rng.uniform() < 0.4:
        size = -0.5 * size
    plant.power_torque[j], plant.power_exponent[j] = size, p
    return Hidden(j, {"Fa": size, "p": p})


@effect("load_friction")
def load_friction(draw: Draw) -> Hidden:
    """mu |load| sign(v); the load is what goes into the links, or their weight alone."""
    plant, load = draw.plant, draw.scales.load
    j = draw.pick([k for k in range(draw.n) if load[k] > 0.35 * load.max()])
    plant.load_share[j] = draw.between(0.05, 0.14)
    static = draw.rng.uniform() < 0.4 and draw.scales.gravity[j] > 0.5 * load[j]
    plant.load_static[j] = float(static)
    return Hidden(j, {"mu": plant.load_share[j], "load": "static" if static else "full"})


@effect("position_friction")
def position_friction(draw: Draw) -> Hidden:
    """(Fc + A cos q + B sin q) sign(v)."""
    j, plant = draw.joint, draw.plant
    size = draw.between(0.25, 0.5) * at_least(plant.coulomb, j, 0.05 * draw.rated)
    phase = draw.between(0, 2 * np.pi)
    plant.position_cos[j], plant.position_sin[j] = size * np.cos(phase), size * np.sin(phase)
    plant.position_order[j] = 1
    return Hidden(j, {"A": plant.position_cos[j], "B": plant.position_sin[j], "order": 1})


@effect("presliding")
def presliding(draw: Draw) -> Hidden:
    """Coulomb friction that needs a way of about d to build up: LuGre or Dahl."""
    j, plant = draw.joint, draw.plant
    fc = at_least(plant.coulomb, j, 0.06 * draw.rated)
    plant.bristle_law[j] = draw.rng.choice([LUGRE, DAHL])
    plant.bristle_length[j] = np.exp(draw.between(np.log(4e-3), np.log(2.5e-2)))
    plant.bristle_damping[j] = 0.2 * plant.viscous[j]
    law = "LuGre" if plant.bristle_law[j] == LUGRE else "Dahl"
    return Hidden(j, {"d": plant.bristle_length[j], "Fc": fc, "law": law})


@effect("cable_hysteresis")
def cable_hysteresis(draw: Draw) -> Hidden:
    """A z, Bouc-Wen: d z' = v - |v| |z|^(n-1) z / 2 - v |z|^n / 2."""
    j, plant = draw.joint, draw.plant
    plant.cable_torque[j] = draw.between(0.03, 0.10) * draw.rated
    plant.cable_length[j] = draw.between(0.06, 0.35)
    plant.cable_exponent[j] = draw.rng.choice([1.0, 1.0, 2.0])
    values = {"A": plant.cable_torque[j], "d": plant.cable_length[j]}
    return Hidden(j, values | {"n": plant.cable_exponent[j]})


@effect("temperature_friction")
def temperature_friction(draw: Draw) -> Hidden:
    """Fv exp(-kv (T - T0)), Fc (1 - kc (T - T0)); every joint warms up, faster than real ones."""
    j, plant = draw.joint, draw.plant
    at_least(plant.viscous, j, 0.10 * draw.rated / draw.speed)
    plant.warms, plant.reference_temperature = 1, 35.0
    plant.warming_time = draw.rng.uniform(25, 60, draw.n)
    plant.idle_temperature = draw.rng.uniform(38, 45, draw.n)
    plant.heating = 8 / (plant.coulomb * draw.scales.bounds.speed * 0.3 + 1e-9)
    plant.viscous_per_kelvin[j] = draw.between(0.02, 0.032)
    plant.coulomb_per_kelvin[j] = draw.between(0.002, 0.006)
    values = {
        "kv_per_K": plant.viscous_per_kelvin[j],
        "kc_per_K": plant.coulomb_per_kelvin[j],
        "T_ref": 35.0,
        "tau_s": plant.warming_time[j],
        "bv_lin": -plant.viscous_per_kelvin[j] * plant.viscous[j],
        "bs_lin": -plant.coulomb_per_kelvin[j] * plant.coulomb[j],
    }
    return Hidden(j, values)


@effect("coupled_friction")
def coupled_friction(draw: Draw) -> Hidden:
    """Friction of a shaft that turns with w = v_j + c v_k, on the last two joints."""
    j, plant, rated = draw.n - 2, draw.plant, draw.scales.rated
    ratio = draw.sign() * draw.rng.choice([1.0, 0.5, 1.5])
    last = rated[j + 1] / abs(ratio)
    size = min(rated[j], last) if draw.rng.uniform() < 0.5 else last
    plant.coupled, plant.coupled_joint, plant.coupled_with = 1, j, j + 1
    plant.coupled_ratio, plant.coupled_coulomb = ratio, draw.between(0.06, 0.15) * size
    speed = draw.scales.bounds.speed[j] + abs(ratio) * draw.scales.bounds.speed[j + 1]
    plant.coupled_viscous = draw.between(0.03, 0.1) * size / speed
    values = {"with_joint": str(j + 2), "c": ratio}
    return Hidden(j, values | {"Fc": plant.coupled_coulomb, "Fv": plant.coupled_viscous})
