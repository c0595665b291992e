/**
 * Extensions of files that other programs print numbers to, without dots; apart from the reader, which the page fetches.
 * Tables (`.csv`) may be points, too, and are a kind of their own.
 */
export const DUMP_EXTENSIONS = ['txt', 'tsv', 'json', 'obj', 'ply', 'dat', 'log', 'out'] as const;
