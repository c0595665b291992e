/** Restores a kept session into the page. */

import { DEFAULT_PLAYBACK, type Playback } from '../../edit/playback.ts';
import type { Store } from '../../edit/store.ts';
import { DEFAULT_TIMELINE_VIEW, type Timeline } from '../../ui/state/timeline.ts';
import type { Observable } from '../../ui/widgets/observable.ts';
import type { ViewCamera } from '../../view/camera/view-camera.ts';
import type { SessionState } from './session-state.ts';

interface PutBackParts {
  readonly store: Store;
  readonly transport: Observable<Playback>;
  readonly timeline: Timeline;
  readonly camera: Pick<ViewCamera, 'view'>;
  readonly saving: { restore(kept: unknown): void };
}

/**
 * Restores document, selection, time, timeline and camera. Playback is paused: it would run away from the current time.
 *
 * @param asStep what is open now is work too, and undo restores it
 */
export function putBack(state: SessionState, parts: PutBackParts, asStep: boolean): void {
  const { store, transport, timeline, camera, saving } = parts;
  const { document, selection } = state;
  // Fields that the record doesn't have get their defaults.
  const then: Playback = { ...DEFAULT_PLAYBACK, ...state.transport, playing: false };
  // Once before the document, since unkeyed changes would be lost when the time changes; and again after it, since the
  // playback range follows the takes.
  transport.set(then);
  store.adopt(asStep ? 'Restore session' : undefined, { document, selection });
  saving.restore(state.saving);
  transport.set(then);
  timeline.view.set({ ...DEFAULT_TIMELINE_VIEW, ...state.timeline });
  camera.view = state.camera;
}
