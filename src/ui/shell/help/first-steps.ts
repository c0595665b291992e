/** Three steps for those who see the page for the first time. They go for good once followed or closed. */
import { type Document, findCharacter } from '../../../model/document.ts';
import type { Selection } from '../../../model/session.ts';
import { arePoints } from '../../../model/skeleton/joint-types.ts';
import type { Uses } from '../../state/workbench.ts';
import { button, element, setText, write } from '../../widgets/dom.ts';
import { icon } from '../../widgets/icons.ts';
import { touchWords } from '../../widgets/touch-words.ts';

const STEPS = {
  pose: ['Drag a hand, a foot or the head', 'Drag a ring to turn a joint', 'Press K to key it'],
  fk: ['Click a joint', 'Drag its ring', 'Press K to key it'],
} as const;
/** The same for those who use no mouse: Tab or F6 tells them. */
const BY_KEYS = ['Press T, type a joint’s name, Enter', 'Press V for its DOF, + and − to turn it', 'Press K to key it'];
/** Keys that nobody presses who has the mouse in the hand. */
const BESIDE_MOUSE = /^(Tab|F6)$/;
const LAST = 3;
type StepsMode = keyof typeof STEPS;
/** Instead of the first one where nothing has hands. */
const DRAG_JOINT = 'Drag a joint';

interface Seen {
  readonly document: Document;
  readonly selection: Selection;
}

export function firstSteps(wb: Uses<'store' | 'settings' | 'posing' | 'guide'>, signal: AbortSignal): HTMLElement {
  let done = 0;
  let isByKeys = false;
  const leave = () => wb.settings.update((s) => ({ ...s, firstSteps: false }));
  const steps = Array.from({ length: LAST }, (_, i) => {
    const text = element('span');
    return { text, row: element('li', {}, element('b', { 'aria-hidden': 'true' }, String(i + 1)), text) };
  });
  const close = button('Close first steps', { class: 'tool small' }, icon('close'), leave);
  const line = element(
    'section',
    { class: 'first-steps', 'aria-label': 'First steps' },
    element('ol', {}, ...steps.map(({ row }) => row)),
    close,
  );
  const show = () => {
    write(line, 'hidden', !areShown(wb));
    const texts = isByKeys ? BY_KEYS : stepTexts(wb);
    steps.forEach(({ row, text }, i) => {
      if (texts) setText(text, isByKeys ? texts[i] : touchWords(texts[i]));
      row.classList.toggle('done', i < done);
      row.classList.toggle('next', i === done);
    });
  };
  const restart = () => {
    done = stepsMode(wb) === 'fk' && wb.store.selection.joint !== undefined ? 1 : 0;
    show();
  };
  const follow = (now: Seen, before: Seen) => {
    if (!wb.settings.get().firstSteps) return;
    done = stepsDone(done, now, before, (!isByKeys && stepsMode(wb)) || 'fk');
    if (done === LAST) leave();
    else show();
  };
  // Previews may be cancelled, so documents count only by their steps.
  wb.store.subscribe((now, { selection }) => follow(now, { document: now.document, selection }));
  wb.store.onStep(follow);
  wb.settings.subscribe((now, before) => {
    if (now.firstSteps === before.firstSteps) return;
    restart();
  });
  wb.posing.mode.subscribe((now, before) => {
    if (now === 'fk' || (before === 'fk' && now === 'pose')) restart();
    else show();
  });
  wb.guide.subscribe(show);
  for (const type of ['keydown', 'pointerdown'] as const) {
    window.addEventListener(
      type,
      (event) => {
        const wasByKeys = isByKeys;
        if (!(event instanceof KeyboardEvent)) isByKeys = false;
        else if (BESIDE_MOUSE.test(event.key)) isByKeys = true;
        if (isByKeys !== wasByKeys) show();
      },
      { capture: true, signal },
    );
  }
  show();
  return line;
}

/** Only in Pose and FK: in the other modes a click or a drag does something else. */
export function areShown(wb: Uses<'store' | 'settings' | 'posing' | 'guide'>): boolean {
  if (wb.guide.get()) return false;
  const { characters } = wb.store.document;
  // Points have nothing to be posed.
  const canPose = characters.some(({ skeleton }) => !arePoints(skeleton));
  return wb.settings.get().firstSteps && canPose && stepsMode(wb) !== undefined;
}

/** What the steps say to those with a mouse; undefined in modes that have none. */
export function stepTexts(wb: Uses<'store' | 'posing'>): readonly string[] | undefined {
  const mode = stepsMode(wb);
  if (mode === undefined) return undefined;
  const hasLimbs = wb.store.document.characters.some(({ skeleton }) =>
    skeleton?.joints.some(({ parent }) => (skeleton.joints[parent]?.parent ?? -1) >= 0),
  );
  return mode === 'pose' && !hasLimbs ? [DRAG_JOINT, ...STEPS.pose.slice(1)] : STEPS[mode];
}

function stepsMode({ posing }: Uses<'posing'>): StepsMode | undefined {
  const mode = posing.mode.get();
  return mode === 'pose' || mode === 'fk' ? mode : undefined;
}

/** How many of the steps are done after a change, of which `done` were before. */
export function stepsDone(done: number, now: Seen, before: Seen, mode: StepsMode): number {
  if (mode === 'fk' && done < 2 && now.selection.joint === undefined) return 0;
  if (mode === 'fk' && done === 0) return 1;
  // Opening others is none of the steps.
  const changed = now.document.characters.flatMap((c) => {
    const was = findCharacter(before.document, c.id);
    return was && was !== c ? [{ was, is: c }] : [];
  });
  if (changed.length === 0) return done;
  if (changed.some(({ was, is }) => was.takes !== is.takes)) return LAST;
  return mode === 'fk' ? Math.max(done, 2) : Math.min(done + 1, 2);
}
