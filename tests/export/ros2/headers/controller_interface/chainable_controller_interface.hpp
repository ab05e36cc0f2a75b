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
