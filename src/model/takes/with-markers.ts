/** Takes with other markers. */
import { inOrder, type Marker } from './markers.ts';
import type { Take } from './take.ts';

/** The take with these markers, in order; none rather than an empty list. */
export function withMarkers<C extends Take>(take: C, markers: readonly Marker[] | undefined): C {
  const { markers: _before, ...rest } = take;
  // The same take but for its markers.
  return (markers?.length ? { ...rest, markers: inOrder(markers) } : rest) as C;
}
