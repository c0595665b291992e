/** What three.js alone draws, as the query of its page says it. */

export type PeerScene =
  /** A cleared canvas: what a frame costs that draws nothing. */
  | { readonly kind: 'empty' }
  /** Copies of `walker.glb`, beside the page. */
  | { readonly kind: 'walkers'; readonly count: number }
  | { readonly kind: 'tentacle'; readonly vertices: number };

export interface PeerView {
  readonly scene: PeerScene;
  readonly shadow: boolean;
  /** Of the canvas, in pixels: as large as that of the built page. */
  readonly size: { readonly width: number; readonly height: number };
}

export const queryOf = (view: PeerView) => `?${new URLSearchParams({ view: JSON.stringify(view) })}`;

/** The view of a query that `queryOf` made. */
export function viewOf(query: string): PeerView {
  return JSON.parse(new URLSearchParams(query).get('view') ?? '');
}
