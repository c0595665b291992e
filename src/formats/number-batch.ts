/**
 * Room for the numbers of a block on their way from bytes to columns: one for all readers, since a sink consumes all
 * numbers before it suspends (`usesUp`). One for each block would be sixteen thousand times the bytes of `keys 0 { }`.
 */

/** Numbers processed at a time. */
export const BATCH = 8192;

/** Scratch, never kept from one flush to the next. */
export const NUMBERS = new Float64Array(BATCH);
