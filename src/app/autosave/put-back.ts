/** Puts a kept session into the page. */
import { DEFAULT_PLAYBACK, type Playback } from '../../edit/playback.ts';
import type { Store } from '../../edit/store.ts';
import type { Observable } from '../../ui/kit/observable.ts';
import { DEFAULT_TIMELINE_VIEW, type Timeline } from '../../ui/state/timeline.ts';
import type { WorkbenchStage } from '../../ui/state/workbench.ts';
import type { SessionState } from './session-state.ts';

interface PutBackParts {
  readonly store: Store;
  readonly transport: Observable<Playback>;
  readonly timeline: Timeline;
  readonly viewport: Pick<WorkbenchStage, 'cameraView'>;
  readonly saving: { restore(kept: unknown): void };
}

/**
 * Document, selection, time, timeline and camera. It stands still: what played when the page went would run away from
 * the moment that was looked at.
 *
 * @param asStep what is open now is work too: undo brings it back
 */
export function putBack(state: SessionState, parts: PutBackParts, asStep: boolean): void {
  const { store, transport, timeline, viewport, saving } = parts;
  const { document, selection } = state;
  // What a newer page knows beside has its default.
  const then: Playback = { ...DEFAULT_PLAYBACK, ...state.transport, playing: false };
  // Before the document: what was set by hand and not keyed is gone at any other moment. And after, for the played
  // range follows the clips.
  transport.set(then);
  store.adopt(asStep ? 'Restore session' : undefined, { document, selection });
  saving.restore(state.saving);
  transport.set(then);
  timeline.view.set({ ...DEFAULT_TIMELINE_VIEW, ...state.timeline });
  viewport.cameraView = state.camera;
}
