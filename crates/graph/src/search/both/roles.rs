//! What a node may be, and sets of that, a bit for each.

/// What a node may be: content or exempt in S₁, content or exempt in S₂, in neither set.
pub(super) const ROLES: usize = 5;

/// The content members of each set.
pub(super) const CONTENT: [usize; 2] = [1, 4];

/// The exempt members of each set.
pub(super) const EXEMPT: [usize; 2] = [2, 8];

/// All members of each set.
pub(super) const MEMBERS: [usize; 2] = [3, 12];

/// Who is in neither set.
pub(super) const REST: usize = 16;
