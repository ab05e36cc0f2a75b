"""What a person brings along: a table of a spreadsheet, a file of another program."""

GERMAN = "Achse\t\u03b8 [deg]\td [mm]\ta [mm]\t\u03b1 [deg]\n" + "\n".join(
    [
        "1\t0\t290\t0\t-90",
        "2\t-90\t0\t270,5\t0",
        "3\t0\t0\t70,5\t-90",
        "4\t0\t302\t0\t90",
        "5\t0\t0\t0\t-90",
        "6\t180\t72\t0\t0",
    ]
)
URDF = """<robot name="two">
<link name="base"/>
<link name="one"><inertial>
<mass value="2"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
<joint name="waist" type="revolute"><parent link="base"/><child link="one"/><axis xyz="0 0 1"/>
<limit lower="-1" upper="1" effort="9" velocity="2"/></joint>
</robot>"""
