import type { ExchangeOptions } from '../shared/options.ts';

/** How a character is written as GLB. */
export interface GlbOptions extends ExchangeOptions {
  /** Between keys: straight lines, or cubic splines, which are fewer but which Blender takes for straight lines. */
  readonly keys: 'linear' | 'cubic';
}

/** The options of a first export. */
export const DEFAULT_GLB: GlbOptions = { keys: 'linear', body: true };
