//! The entry: on a microcontroller the firmware, on a host the soft PLC.

#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg(target_os = "none")]
#[embassy_executor::main]
async fn main(_spawner: embassy_executor::Spawner) {
    plc::boards::pico::run().await
}

#[cfg(not(target_os = "none"))]
fn main() -> std::process::ExitCode {
    plc::boards::host::command::run()
}
