#pragma once
#include <string>
namespace hardware_interface { struct CommandInterface {
    CommandInterface(const std::string &, const std::string &, double *); }; }
