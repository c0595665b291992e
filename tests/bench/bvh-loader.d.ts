/** The npm package has no types: declares what the bench calls. */
declare module 'bvh-loader/module/bvh-loader.js' {
  export class MEBvh {
    keyframes: number[][] | null;
    _parse_hierarchy(text: string): void;
    parse_motion(text: string): void;
  }
}
