/** Autosave in a page: its window events, and what the page shows of it. */

import { sessionLocks } from '../../io/session-locks.ts';
import { sessionStore } from '../../io/session-store.ts';
import { write } from '../../ui/widgets/dom.ts';
import type { DiskHandles } from '../disk-handles.ts';
import type { Unsaved } from '../unsaved.ts';
import { Autosave, type AutosaveParts, type TimeBefore } from './autosave.ts';
import { savingMarks } from './saving-marks.ts';

/** What autosave follows. */
export interface FollowedParts extends Omit<AutosaveParts, 'sessions' | 'locks' | 'saving'> {
  readonly unsaved: Unsaved;
  readonly handles: DiskHandles;
}

/** @param before what happened since the page was loaded */
export function startAutosave(
  { unsaved, handles, ...parts }: FollowedParts,
  before: TimeBefore,
  page: Window = window,
): void {
  const { documentElement } = page.document;
  const saving = savingMarks(unsaved, handles, parts.timeline.review);
  const autosave = new Autosave(
    { ...parts, saving, sessions: sessionStore(), locks: sessionLocks() },
    before,
    (state) => {
      write(documentElement.dataset, 'autosave', state);
    },
  );
  const options = { capture: true, passive: true };
  const up = () => {
    autosave.setPointerDown(false);
    autosave.touched();
  };
  page.addEventListener('pointerdown', () => autosave.setPointerDown(true), options);
  page.addEventListener('pointerup', up, options);
  page.addEventListener('pointercancel', up, options);
  // A drag and drop (a row of a list, a file) ends without a pointer event.
  page.addEventListener('dragend', up, options);
  page.addEventListener('wheel', () => autosave.touched(), options);
  page.addEventListener('keyup', () => autosave.touched(), options);
  // The last event that a page is certain to get, above all on phones.
  page.document.addEventListener('visibilitychange', () => {
    if (page.document.visibilityState === 'hidden') autosave.saveAtOnce();
  });
  page.addEventListener('pagehide', () => autosave.saveAtOnce());
  void autosave.offer();
}
