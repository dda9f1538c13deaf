//! Bodies, what holds and loads them, and time: the scene every solver moves.
