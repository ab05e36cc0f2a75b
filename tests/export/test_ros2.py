"""The package for ROS 2: its core tracks a motion without ROS, the rest compiles on stand-ins."""

import subprocess
import xml.etree.ElementTree as ET

import pytest

from modeler.api import export, load
from modeler.cli import main
from modeler.core.errors import ModelerError
from modeler.robot import robot_from_text

HARNESS = """
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include "computed_torque.hpp"
using namespace PACKAGE;

static Vector accelerations(const Vector &q, const Vector &qd, const Vector &tau)
{
    double M[joints * joints];
    Vector still{}, x{};
    PREFIX_inverse_dynamics(q.data(), qd.data(), still.data(), beta_at_export.data(), x.data());
    Vector rest{};
    PREFIX_inverse_dynamics(q.data(), still.data(), still.data(), beta_at_export.data(),
                            rest.data());
    for (std::size_t j = 0; j < joints; j++) {
        Vector unit{}, column{};
        unit[j] = 1.0;
        PREFIX_inverse_dynamics(q.data(), still.data(), unit.data(), beta_at_export.data(),
                                column.data());
        for (std::size_t i = 0; i < joints; i++)
            M[i * joints + j] = column[i] - rest[i];
    }
    for (std::size_t i = 0; i < joints; i++)
        x[i] = tau[i] - x[i];
    for (std::size_t k = 0; k < joints; k++)
        for (std::size_t i = k + 1; i < joints; i++) {
            const double share = M[i * joints + k] / M[k * joints + k];
            for (std::size_t j = k; j < joints; j++)
                M[i * joints + j] -= share * M[k * joints + j];
            x[i] -= share * x[k];
        }
    for (std::size_t i = joints; i-- > 0;) {
        for (std::size_t j = i + 1; j < joints; j++)
            x[i] -= M[i * joints + j] * x[j];
        x[i] /= M[i * joints + i];
    }
    return x;
}

int main(int, char **argv)
{
    ComputedTorque control;
    const double factor = std::atof(argv[1]), limit = std::atof(argv[2]), h = 1e-4;
    for (auto &x : control.beta)
        x *= factor;
    control.kp.fill(400.0);
    control.kd.fill(40.0);
    if (limit > 0.0)
        control.limit.fill(limit);
    Vector q{}, qd{}, tau{};
    q.fill(0.1);
    double worst = 0.0, largest = 0.0;
    for (int k = 0; k < 20000; k++) {
        Reference wanted{};
        for (std::size_t i = 0; i < joints; i++) {
            const double w = 2.0 + static_cast<double>(i), t = k * h;
            wanted.q[i] = 0.5 * std::sin(w * t);
            wanted.qd[i] = 0.5 * w * std::cos(w * t);
            wanted.qdd[i] = -0.5 * w * w * std::sin(w * t);
            if (k > 10000)
                worst = std::fmax(worst, std::fabs(q[i] - wanted.q[i]));
        }
        if (k % 10 == 0 && control.update(q, qd, wanted, tau) != 0)
            return 1;
        for (double x : tau)
            largest = std::fmax(largest, std::fabs(x));
        const Vector a = accelerations(q, qd, tau);
        for (std::size_t i = 0; i < joints; i++) {
            qd[i] += h * a[i];
            q[i] += h * qd[i];
        }
    }
    q[0] = NAN;
    const int status = control.update(q, qd, Reference{}, tau);
    const double left = tau[0];
    q[0] = 0.1;
    control.limit[0] = NAN;
    const int unlimited = control.update(q, qd, Reference{}, tau);
    std::printf("%.17g %.17g %d %g %d %g\\n", worst, largest, status, left, unlimited, tau[0]);
}
"""

STAND_INS = {
    "controller_interface/chainable_controller_interface.hpp": """
#include <memory>
#include <string>
#include <vector>
#include "hardware_interface/handle.hpp"
#include "rclcpp/rclcpp.hpp"
#include "rclcpp_lifecycle/state.hpp"
namespace controller_interface {
enum class CallbackReturn { SUCCESS, FAILURE, ERROR };
enum class return_type { OK, ERROR };
enum class interface_configuration_type { ALL, INDIVIDUAL, NONE };
struct InterfaceConfiguration {
    interface_configuration_type type; std::vector<std::string> names; };
struct Loaned { double get_value() const; bool set_value(double); };
class ChainableControllerInterface {
public:
    virtual ~ChainableControllerInterface() = default;
    virtual CallbackReturn on_init() = 0;
    virtual InterfaceConfiguration command_interface_configuration() const = 0;
    virtual InterfaceConfiguration state_interface_configuration() const = 0;
    virtual CallbackReturn on_configure(const rclcpp_lifecycle::State &);
    virtual CallbackReturn on_activate(const rclcpp_lifecycle::State &);
    virtual CallbackReturn on_deactivate(const rclcpp_lifecycle::State &);
    std::shared_ptr<rclcpp::Node> get_node() const;
protected:
    virtual std::vector<hardware_interface::CommandInterface> on_export_reference_interfaces() = 0;
    virtual return_type update_reference_from_subscribers(
        const rclcpp::Time &, const rclcpp::Duration &) = 0;
    virtual return_type update_and_write_commands(
        const rclcpp::Time &, const rclcpp::Duration &) = 0;
    template <typename T> void auto_declare(const std::string &, const T &);
    std::vector<double> reference_interfaces_;
    std::vector<Loaned> command_interfaces_, state_interfaces_;
};
}
""",
    "hardware_interface/handle.hpp": """
#pragma once
#include <string>
namespace hardware_interface { struct CommandInterface {
    CommandInterface(const std::string &, const std::string &, double *); }; }
""",
    "rclcpp/rclcpp.hpp": """
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>
#define RCLCPP_ERROR(logger, ...) ((void)(logger), (void)std::snprintf(nullptr, 0, __VA_ARGS__))
namespace rclcpp {
struct Logger {}; struct Time {}; struct Duration {}; struct SystemDefaultsQoS {};
struct Parameter {
    std::vector<std::string> as_string_array() const;
    std::vector<double> as_double_array() const; };
template <typename T> struct Subscription {};
struct Node {
    Logger get_logger() const; const char *get_name() const;
    Parameter get_parameter(const std::string &) const;
    template <typename T> std::shared_ptr<Subscription<T>> create_subscription(
        const std::string &, const SystemDefaultsQoS &,
        std::function<void(const std::shared_ptr<T>)>); };
}
""",
    "rclcpp_lifecycle/state.hpp": "#pragma once\nnamespace rclcpp_lifecycle { struct State {}; }\n",
    "realtime_tools/realtime_buffer.hpp": """
namespace realtime_tools { template <typename T> struct RealtimeBuffer {
    void writeFromNonRT(const T &); T *readFromRT(); }; }
""",
    "trajectory_msgs/msg/joint_trajectory_point.hpp": """
#include <vector>
namespace trajectory_msgs::msg { struct JointTrajectoryPoint {
    std::vector<double> positions, velocities, accelerations, effort; }; }
""",
    "pluginlib/class_list_macros.hpp": """
#define PLUGINLIB_EXPORT_CLASS(type, base) static_assert(std::is_base_of_v<base, type>); \\
    base *made() { return new type; }
""",
}
"""Headers of ROS 2 Jazzy, as far as the controller uses them."""

HOT = '[effects]\ntemperature_friction = "all"'
WARNED = ("-Wall", "-Wextra", "-Wconversion", "-Werror")


@pytest.fixture(scope="module", params=["demo-arm", "five-bar"])
def package(request, tmp_path_factory):
    folder = tmp_path_factory.mktemp("ros2") / "package"
    return export(load(request.param), folder, to="ros2"), folder


def run(*words) -> str:
    done = subprocess.run(list(map(str, words)), capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_the_core_tracks_a_motion_without_ros(package, tmp_path) -> None:
    found, folder = package
    if found.robot != "demo-arm":
        pytest.skip("the harness is for trees")
    name = ET.parse(folder / "package.xml").getroot().findtext("name")
    text = HARNESS.replace("PACKAGE", name).replace("PREFIX", "demo_arm")
    (tmp_path / "harness.cpp").write_text(text)
    sources = sorted((folder / "src").glob("*.c"))
    for source in sources:
        run("gcc", "-std=c99", "-O1", "-c", source, "-o", tmp_path / f"{source.stem}.o")
    run("g++", "-std=c++17", "-O1", *WARNED, "-I", folder / "src", tmp_path / "harness.cpp",
        *tmp_path.glob("*.o"), "-o", tmp_path / "harness")  # fmt: skip
    right, largest, *told = map(float, run(tmp_path / "harness", 1.0, 0.0).split())
    wrong = float(run(tmp_path / "harness", 0.7, 0.0).split()[0])
    assert right < 2e-3 < wrong  # rad; it begins 0.1 rad away
    assert told == [3.0, 0.0, 3.0, 0.0]  # a position, then a limit that is no number
    limited = float(run(tmp_path / "harness", 1.0, largest / 3).split()[1])
    assert limited == pytest.approx(largest / 3, rel=1e-5)


def test_the_controller_compiles_on_stand_ins_of_ros(package, tmp_path) -> None:
    _, folder = package
    for name, text in STAND_INS.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
    run("g++", "-std=c++17", "-fsyntax-only", *WARNED, "-Wno-sign-conversion", "-isystem", tmp_path,
        "-I", folder / "src", folder / "src" / "controller.cpp")  # fmt: skip


def test_the_files_name_one_another(package) -> None:
    found, folder = package
    name = ET.parse(folder / "package.xml").getroot().findtext("name")
    made = ET.parse(folder / "plugin.xml").getroot()
    assert made.get("path") == name
    assert made.find("class").get("type") == f"{name}::Controller"
    assert (
        f"PLUGINLIB_EXPORT_CLASS({name}::Controller" in found.files["src/controller.cpp"].decode()
    )
    cmake = found.files["CMakeLists.txt"].decode()
    assert all(f"src/{p.name}\n" in cmake for p in (folder / "src").glob("*.c"))
    assert f"type: {name}/Controller" in found.files["config/controller.yaml"].decode()


def test_a_package_is_written_again(tmp_path, capsys) -> None:
    words = ["export", "two-link", "--to", "ros2", "--out", str(tmp_path / "p")]
    assert main(words) == main(words) == 0
    (tmp_path / "p" / "README.md").write_text("mine")
    assert main(words) == 1
    assert "README.md: there is such a file with another content" in capsys.readouterr().err
    assert main([*words, "--force"]) == 0
    assert (tmp_path / "p" / "README.md").read_text() != "mine"
    assert main([*words[:2], "--to", "urdf", "--out", str(tmp_path / "p")]) == 1
    assert "p: is a folder; expected the name of a file" in capsys.readouterr().err


def test_what_is_refused(tmp_path) -> None:
    text = load("demo-arm").text
    robot = robot_from_text(text.replace("[effects]", HOT), "hot")
    for to in ("ros2", "fmu"):
        with pytest.raises(ModelerError, match="its effects read temperature, which"):
            export(robot, tmp_path / "p", to=to)
        with pytest.raises(ModelerError, match="wrist: a robot without values; write"):
            export(load("wrist"), tmp_path / "p", to=to)
        with pytest.raises(ModelerError, match=f"arm.urdf: is for robot files, and to says {to}"):
            export(robot, tmp_path / "p", to=to, like="arm.urdf")
