//! Long arrays in pieces, spread over all processors.
//!
//! A piece is computed by itself, so the result has the same bits whatever the number of threads. Short arrays stay
//! in the thread that asks.

use rayon::prelude::*;
use std::sync::{Arc, Mutex, PoisonError};

/// The threads of this process, begun when they are first needed.
///
/// A forked process (Python's `multiprocessing` makes them) inherits the pool but not its threads, and would wait for
/// them for ever; so it begins its own.
fn pool() -> Option<Arc<rayon::ThreadPool>> {
    static POOL: Mutex<Option<(u32, Arc<rayon::ThreadPool>)>> = Mutex::new(None);
    let process = std::process::id();
    let mut found = POOL.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((owner, pool)) = found.as_ref() {
        if *owner == process {
            return Some(Arc::clone(pool));
        }
        // Dropping the pool of the parent would tell its threads to end, and they are not here.
        std::mem::forget(found.take());
    }
    let pool = Arc::new(rayon::ThreadPoolBuilder::new().build().ok()?);
    *found = Some((process, Arc::clone(&pool)));
    Some(pool)
}

/// Calls `work` with each piece of the input and the piece of the output that belongs to it.
pub(crate) fn each_piece<T: Sync, U: Send>(
    input: &[T],
    output: &mut [U],
    input_piece: usize,
    output_piece: usize,
    work: impl Fn(&[T], &mut [U]) + Sync,
) {
    if let Some(pool) = (input.len() > input_piece).then(pool).flatten() {
        let pieces = input.par_chunks(input_piece).zip(output.par_chunks_mut(output_piece));
        pool.install(|| pieces.for_each(|(from, to)| work(from, to)));
        return;
    }
    for (from, to) in input.chunks(input_piece).zip(output.chunks_mut(output_piece)) {
        work(from, to);
    }
}

/// Calls `work` with each piece of an array that is changed in place.
pub(crate) fn each_piece_in_place<T: Send>(values: &mut [T], piece: usize, work: impl Fn(&mut [T]) + Sync) {
    if let Some(pool) = (values.len() > piece).then(pool).flatten() {
        let pieces = values.par_chunks_mut(piece);
        pool.install(|| pieces.for_each(&work));
        return;
    }
    values.chunks_mut(piece).for_each(work);
}
