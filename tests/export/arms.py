"""A small arm as URDF, MJCF and SDF, written as people write them; what is needed to compare."""

import dataclasses
import re
from pathlib import Path

import numpy as np

from modeler.api import compile_model, derive, generate
from modeler.estimation import PREFIXES
from modeler.robot import Robot, read_robot

URDF = b"""<?xml version='1.0'?>
<!-- an arm -->
<robot name='arm'>
  <link name="base"><visual><geometry><mesh filename="package://x/base.stl"/></geometry></visual></link>
  <link name="upper">
    <inertial>
      <origin xyz="0.01 0.02 0.15" rpy="0.3 -0.2 0.5"/> <!-- weighed -->
      <mass value='2.50'/>
      <inertia ixx="0.031" ixy="0.001" ixz="-0.002" iyy="0.033" iyz="0.0005" izz="0.006" />
    </inertial>
  </link>
  <joint name="shoulder" type="revolute">
    <origin xyz="0 0 0.3" rpy="0 0.4 0"/> <parent link="base"/> <child link="upper"/>
    <axis xyz="0 1 0"/>
    <limit lower="-2" upper="2" velocity="3" effort="50"/>
    <dynamics friction="0.7" damping="1.2"/>
  </joint>
  <link name="fore">
    <inertial><mass value="1.5"/>
      <inertia ixx="0.02" iyy="0.02" izz="0.004" ixy="0" ixz="0" iyz="0"/></inertial>
  </link>
  <joint name="elbow" type="continuous">
    <parent link="upper"/><child link="fore"/>
    <origin xyz="0.05 0 0.3" rpy="1.5708 0 0"/>
    <axis xyz="0 0 -1"/>
  </joint>
  <link name="slider"/>
  <joint name="slide" type="prismatic">
    <parent link="fore"/><child link="slider"/> <origin xyz="0 0.1 0.2"/> <axis xyz="1 0 0"/>
    <limit lower="-0.1" upper="0.2" velocity="0.5" effort="20"/>
    <dynamics damping="4"/>
  </joint>
  <link name="tool">
    <inertial>
      <origin xyz="0 0 0.05"/><mass value="0.3"/>
      <inertia ixx="0.001" ixy="0" ixz="0" iyy="0.001" iyz="0" izz="0.0004"/>
    </inertial>
  </link>
  <joint name="glue" type="fixed"><parent link="fore"/><child link="tool"/>
    <origin xyz="0 0 0.1"/></joint>
  <link name="finger">
    <inertial><origin xyz="0.02 0 0"/><mass value="0.2"/>
      <inertia ixx="0.0002" ixy="0" ixz="0" iyy="0.0003" iyz="0" izz="0.0003"/></inertial>
  </link>
  <joint name="tip" type="fixed"><parent link="slider"/><child link="finger"/></joint>
  <transmission name="t"><joint name="shoulder"/><actuator name="m"/></transmission>
</robot>
"""
"""Quotes of both kinds, elements in one line, turned inertia, a tool and a finger on fixed joints,
a slide that moves a link without mass, joints without dynamics."""

MJCF = b"""<mujoco model="arm">
  <compiler angle="degree" eulerseq="zyx"/>
  <option gravity="0 0 -9.81"/>
  <default>
    <joint armature="0.05" damping="0.4"/>
    <default class="stiff"><joint damping="2" frictionloss="0.3"/></default>
  </default>
  <worldbody>
    <body name="upper" pos="0 0 0.3" euler="0 10 0">  <!-- first -->
      <inertial pos="0.01 0 0.15" mass="2.5" diaginertia="0.03 0.028 0.006" euler="5 10 20"/>
      <joint name="shoulder" axis="0 1 0" class="stiff" range="-120 120"/>
      <geom type="capsule" size="0.04" fromto="0 0 0 0 0 0.3"/>
      <body name="fore" pos="0.05 0 0.3">
        <joint name="roll" axis="1 0 0"/>
        <joint name="elbow" axis="0 0 1" pos="0 0.02 0"/>
        <geom type="capsule" size='0.03' fromto="0 0 0 0 0 0.25" mass="1.5"/>
        <body name="tool" pos="0 0 0.25">
          <inertial pos="0 0 0.02" mass="0.2" fullinertia="0.0004 0.0004 0.0002 1e-5 0 0"/>
        </body>
      </body>
    </body>
  </worldbody>
  <actuator><motor joint="shoulder"/><motor joint="roll"/><motor joint="elbow" gear="2"/></actuator>
</mujoco>
"""
"""Defaults, several joints in a body, a body whose geom weighs, a principal frame by angles."""

SDF = b"""<?xml version="1.0"?>
<sdf version="1.7"><model name="arm">
  <link name="base"/>
  <link name="upper">
    <pose>0 0 0.3 0 0.4 0</pose>
    <inertial>
      <pose>0.01 0.02 0.15 0.3 -0.2 0.5</pose>
      <mass>2.50</mass>
      <inertia><ixx>0.031</ixx><ixy>0.001</ixy><ixz>-0.002</ixz><iyy>0.033</iyy><iyz>0.0005</iyz><izz>0.006</izz></inertia>
    </inertial>
  </link>
  <joint name="shoulder" type="revolute"><parent>base</parent><child>upper</child>
    <axis><xyz>0 1 0</xyz><dynamics><damping>1.2</damping><friction>0.7</friction></dynamics></axis>
  </joint>
  <link name="fore">
    <pose relative_to="upper">0.05 0 0.3 1.5708 0 0</pose>
    <inertial><mass>1.5</mass>
      <inertia><ixx>0.02</ixx><iyy>0.02</iyy><izz>0.004</izz></inertia></inertial>
  </link>
  <joint name="elbow" type="revolute"><parent>upper</parent><child>fore</child>
    <axis><xyz>0 0 -1</xyz></axis></joint>
  <link name="slider"><pose relative_to="fore">0 0.1 0.2 0 0 0</pose></link>
</model></sdf>
"""

_NUMBER = re.compile(rb'(?<=["\'> ])-?\d+\.?\d*(?:e-?\d+)?(?=["\'< ])')


def written(folder: Path, name: str, data: bytes) -> Path:
    """The file."""
    place = folder / name
    place.write_bytes(data)
    return place


def without_numbers(data: bytes) -> bytes:
    """The text with every number as one letter."""
    return _NUMBER.sub(b"N", _NUMBER.sub(b"N", data))


def without_comment(data: bytes) -> bytes:
    """The text without the comment that an export puts."""
    return re.sub(rb"<!-- modeler export: .*?-->\r?\n", b"", data, flags=re.DOTALL)


def changed(robot: Robot, rng: np.random.Generator, rows: str = "") -> Robot:
    """Heavier or lighter bodies, that hang elsewhere; other friction."""
    values = dict(robot.parameters)
    for row in [joint.name for joint in robot.moving]:
        names = [f"{prefix}{row}" for prefix in PREFIXES]
        if all(name in values for name in names) and (not rows or row in rows):
            more = rng.uniform(0.1, 0.4) * values[f"M{row}"]
            at = rng.uniform(-0.1, 0.1, 3)
            point = more * (at @ at * np.eye(3) - np.outer(at, at))
            round_ = more * 0.05**2 * np.eye(3)
            add = [*(point + round_)[np.triu_indices(3)], *(more * at), more]
            values |= {n: values[n] + x for n, x in zip(names, map(float, add), strict=True)}
    for name in values:
        if name.startswith(("Fv", "Fs", "Ia")) and values[name]:
            values[name] *= float(rng.uniform(0.5, 1.5))
    return dataclasses.replace(robot, parameters=values)


def same_physics(one: Robot, other: Robot, share: float = 1e-9) -> bool:
    """Torques of both, nominal values, at random states."""
    rng = np.random.default_rng()
    q, qd, qdd = (rng.uniform(-1.0, 1.0, (50, len(one.coordinates))) for _ in range(3))
    found = []
    for robot in (one, other):
        model = compile_model(generate(derive(robot)))
        chi = np.array([p.nominal or 0.0 for p in model.spec.standard])
        found.append(model.inverse_dynamics(q, qd, qdd, model.base_parameters(chi)))
    return bool(np.abs(found[0] - found[1]).max() <= share * np.abs(found[0]).max())


def reread(folder: Path, name: str, data: bytes) -> Robot:
    """The robot of an exported file."""
    return read_robot(written(folder, name, data))
