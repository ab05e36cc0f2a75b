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
