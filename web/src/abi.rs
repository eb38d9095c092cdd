//! The functions that WebAssembly exports. Text goes through one buffer: the page makes room for a
//! question with [`playground_buffer`], writes it there, calls [`playground_answer`], and reads the
//! answer from where [`playground_buffer`] of its length then is.

use std::cell::RefCell;

thread_local! {
    static BUFFER: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
}

/// Makes the buffer this long and says where it is. What it holds stays as far as it fits.
// SAFETY: no other function of the program has this name.
#[allow(unsafe_code, reason = "an exported name")]
#[unsafe(no_mangle)]
pub extern "C" fn playground_buffer(length: usize) -> *mut u8 {
    BUFFER.with_borrow_mut(|buffer| {
        buffer.resize(length, 0);
        buffer.as_mut_ptr()
    })
}

/// Answers the question in the buffer and puts the answer there; its length in bytes.
// SAFETY: no other function of the program has this name.
#[allow(unsafe_code, reason = "an exported name")]
#[unsafe(no_mangle)]
pub extern "C" fn playground_answer() -> usize {
    BUFFER.with_borrow_mut(|buffer| {
        let answer = crate::answer(&String::from_utf8_lossy(buffer));
        *buffer = answer.into_bytes();
        buffer.len()
    })
}
