//! The name by which programs find the shared library: the major and the minor version, as the
//! interface may change with either.

use std::env;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let of = |name: &str| env::var(name).unwrap_or_default();
    let version = [of("CARGO_PKG_VERSION_MAJOR"), of("CARGO_PKG_VERSION_MINOR")].join(".");
    match &*of("CARGO_CFG_TARGET_OS") {
        "linux" => {
            println!("cargo::rustc-cdylib-link-arg=-Wl,-soname,libtunnelproof_c.so.{version}");
        }
        "macos" => println!(
            "cargo::rustc-cdylib-link-arg=-Wl,-install_name,@rpath/libtunnelproof_c.{version}.dylib"
        ),
        _ => {}
    }
}
