// A library that was built for another version of the interface.
extern "C" int roboss_control_program_abi() {
    return 9999;
}
extern "C" void* roboss_control_program() {
    return nullptr;
}
