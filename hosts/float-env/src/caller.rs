//! The environment of a caller, restored in the end.

use crate::Control;

/// Restores the control bits of a caller when it is dropped: also when a panic unwinds.
pub(crate) struct Caller(Control);

impl Caller {
    /// To be restored to what they are now.
    pub(crate) fn current() -> Self {
        Caller(Control::current())
    }

    /// To be restored to these, which they are now; until then they are the default.
    pub(crate) fn leave(control: Control) -> Self {
        // SAFETY: this is what Rust code assumes.
        unsafe { Control::DEFAULT.set() };
        Caller(control)
    }
}

impl Drop for Caller {
    #[inline(always)]
    fn drop(&mut self) {
        // SAFETY: the foreign code that called had set this; it goes on with it. What Rust code
        // computes is done by then, or starts with another change to the default.
        unsafe { self.0.set() };
    }
}
