/** Extensions of files that other programs print numbers to, without dots; apart from the reader, which the page fetches. */
export const DUMP_EXTENSIONS = ['txt', 'csv', 'tsv', 'json', 'obj', 'ply', 'dat', 'log', 'out'] as const;
