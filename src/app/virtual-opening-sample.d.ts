/** What the page opens with, by `plugins/opening-sample.ts`. */
declare module 'virtual:opening-sample' {
  /** Of a `PackedExample`; undefined in development. */
  export const address: string | undefined;
}
