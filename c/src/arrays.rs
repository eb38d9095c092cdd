//! Arrays behind pointers, and what is refused of them.

use std::ffi::{CStr, c_char};
use std::slice;

use crate::NULL;

/// `tunnelproof_error`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Error {
    pub(crate) code: i32,
    pub(crate) array: *const c_char,
    pub(crate) index: usize,
    pub(crate) corner: usize,
    pub(crate) value: f64,
}

impl Error {
    pub(crate) fn new(code: i32, array: &'static CStr) -> Self {
        Error {
            code,
            array: array.as_ptr(),
            index: 0,
            corner: 0,
            value: 0.0,
        }
    }

    pub(crate) fn null(array: &'static CStr) -> Self {
        Error::new(NULL, array)
    }
}

/// The name of an array of a mesh as C has it.
pub(crate) fn name(array: &str) -> &'static CStr {
    const NAMES: [&CStr; 7] = [
        c"clearance",
        c"edges",
        c"end",
        c"faces",
        c"groups",
        c"start",
        c"thickness",
    ];
    let is_it = |name: &&&CStr| name.to_bytes() == array.as_bytes();
    NAMES.iter().find(is_it).unwrap_or(&c"vertices")
}

/// Reads an array.
///
/// # Safety
///
/// The pointer is null or points to `count` items, of which nobody changes one during `'a`.
pub(crate) unsafe fn read<'a, T>(
    items: *const T,
    count: usize,
    array: &'static CStr,
) -> Result<&'a [T], Error> {
    if count == 0 {
        return Ok(&[]);
    }
    if items.is_null() {
        return Err(Error::null(array));
    }
    // SAFETY: it is not null, and the rest is the caller's promise.
    Ok(unsafe { slice::from_raw_parts(items, count) })
}

/// Writes as many items as there is room for. Nothing is written to null.
///
/// # Safety
///
/// The pointer is null or points to memory for `capacity` items that nobody else uses during the
/// call.
pub(crate) unsafe fn write<T>(items: *mut T, capacity: usize, all: impl Iterator<Item = T>) {
    if items.is_null() {
        return;
    }
    for (index, item) in all.take(capacity).enumerate() {
        // SAFETY: it is not null, and the index is below the capacity.
        unsafe { items.add(index).write(item) };
    }
}

/// The result of a function, or the code of its error, which is written unless the pointer is null.
///
/// # Safety
///
/// The pointer is null or points to memory for an error that nobody else uses during the call.
pub(crate) unsafe fn answered<T: From<i32>>(result: Result<T, Error>, error: *mut Error) -> T {
    result.unwrap_or_else(|refused| {
        // SAFETY: it is the caller's promise, and the capacity is 1.
        unsafe { write(error, 1, [refused].into_iter()) };
        refused.code.into()
    })
}
