/**
 * The right panel: lil-gui, styled like the rest of the page. Compares by identity: rows are rebuilt for another
 * character, joint, unit or other limits, and only updated while a character plays or a slider is dragged.
 */

import { GUI } from 'lil-gui';
import { type Character, findCharacter, shownTake } from '../../../model/document.ts';
import { jointsIn } from '../../../model/skeleton/selected-joints.ts';
import { currentCharacter } from '../../state/actions/action.ts';
import { HandEdit } from '../../state/actions/hand-edit.ts';
import { handleKey } from '../../state/actions/keys.ts';
import { followWithNumbers } from '../../state/follow-time.ts';
import { onDemand } from '../../state/on-demand.ts';
import type { PosingMode } from '../../state/posing.ts';
import type { Uses, Workbench } from '../../state/workbench.ts';
import { element, setAttribute, write } from '../../widgets/dom.ts';
import { isTextField, leaveField } from '../../widgets/focus/focus.ts';
import { SECTION } from '../../widgets/focus/focus-regions.ts';
import { oncePerFrame } from '../../widgets/frame.ts';
import { contentOf, isOpen } from '../../widgets/section.ts';
import { IkSection } from '../ik/ik-section.ts';
import type { LimbSection } from '../limbs/limb-section.ts';
import { selectedLimbs } from '../limbs/selected-limbs.ts';
import type { RigSection } from '../rig/rig-section.ts';
import { CharacterSection } from './character-section.ts';
import { DofSections } from './dof-sections.ts';
import { flashDropped } from './dropped-rows.ts';
import { jointFacts } from './joint-facts.ts';
import { LiveRows } from './live-rows.ts';
import { displaySection, playbackSection } from './page-sections.ts';

/** Another display may be another pose: that of the stepped preview. */
const SHOWN_SETTINGS = ['angles', 'timeDisplay', 'display'] as const;

/** @param panel empty, already in the page (`inspector-panel.ts`) */
export function fillInspector(wb: Workbench, panel: HTMLElement): void {
  const gui = new GUI({ container: panel, autoPlace: false, injectStyles: false, title: 'Inspector' });
  const empty = element('p', { class: 'empty' }, 'Open a character to see its DOFs, morphs and details.');
  contentOf(gui).prepend(empty);

  const section = (id: string, title: string, open: boolean): GUI => rememberedSection(wb, gui, id, title, open);
  const edit = new HandEdit(wb.store, wb.messages);
  const live = new LiveRows(contentOf(gui));
  const rig = rigSection(wb, edit, section('rig', 'Rig', true));
  const dofs = new DofSections({ wb, edit, live }, gui, section);
  const showLimb = limbSection(wb, section('limb', 'Limb', true));
  const ik = new IkSection(wb, section('ik', 'IK', true));
  const facts = jointFacts(wb);
  const factsSection = section('facts', 'Details', true);
  contentOf(factsSection).append(facts.element);
  const character = new CharacterSection(wb, edit, section('character', 'Character', false));
  const display = section('display', 'Bones and onion skin', false);
  const playback = section('playback', 'Playback and units', false);
  for (const wide of [display, playback]) wide.domElement.classList.add('wide-names');
  displaySection(wb, display);
  playbackSection(wb, playback);

  let shown: Shown | undefined;
  const show = () => {
    const next = whatIsShown(wb);
    const target = findCharacter(wb.store.document, next.id);
    const isSame = shown?.id === next.id && shown !== undefined && sameJoints(shown, next);
    const goBack = isSame ? placeIn(contentOf(gui)) : undefined;
    if (!shown || !sameDofs(shown, next)) dofs.rebuild(target, next.joints);
    if (!shown || !sameCharacterRows(shown, next)) character.rebuild(target);
    write(empty, 'hidden', target !== undefined);
    const { joint, vertex } = wb.store.selection;
    factsSection.show(target !== undefined && (joint ?? vertex) !== undefined);
    shown = next;
    character.update(target);
    dofs.showUnkeyed(target);
    showLimb();
    ik.update();
    rig(target, next.joints);
    facts.show();
    goBack?.();
    live.update();
  };
  const showSoon = oncePerFrame(show);
  wb.store.subscribe((now, before) => {
    flashDropped(wb, panel, now.document, before.document);
    showSoon();
  });
  wb.posing.litDof.subscribe((lit) => {
    const own = lit && lit.characterId === currentCharacter(wb)?.id ? String(lit.dof) : undefined;
    for (const row of panel.querySelectorAll<HTMLElement>('.dof')) {
      row.classList.toggle('lit', own !== undefined && row.dataset.dof === own);
    }
  });
  wb.settings.subscribe((now, before) => {
    if (SHOWN_SETTINGS.some((name) => now[name] !== before[name])) showSoon();
  });
  wb.transport.subscribe((now, before) => {
    if (now.framesPerSecond !== before.framesPerSecond) showSoon();
  });
  followWithNumbers(wb.transport, () => {
    live.update();
    facts.fill();
  });
  show();

  // lil-gui stops key events; those that a control doesn't use are forwarded first.
  const handOn = (event: KeyboardEvent) => {
    const { target } = event;
    // lil-gui would leave the focus to the page.
    if (event.key === 'Enter' && !event.isComposing && target instanceof HTMLInputElement && isTextField(target)) {
      leaveField(target);
    }
    if (target instanceof Element && target.closest('.lil-controller')) handleKey(wb, event);
  };
  panel.addEventListener('keydown', handOn, { capture: true });
  // What is typed is compared with the number, and counts from it: one of an earlier frame would make it another
  // change.
  panel.addEventListener('focus', () => live.update(), { capture: true });
}

/** Shown in rig mode, and loaded with it. */
function rigSection(wb: Workbench, edit: HandEdit, section: GUI) {
  let rows: RigSection | undefined;
  let shown: readonly [Character | undefined, readonly number[]] = [undefined, []];
  const show = async (mode: PosingMode) => {
    section.show(mode === 'rig');
    if (mode !== 'rig') return;
    if (rows) return rows.show(...shown);
    const module = await onDemand(wb.messages, 'The Rig section', () => import('../rig/rig-section.ts'));
    rows ??= module && new module.RigSection(wb, edit, section);
    rows?.show(...shown);
  };
  wb.posing.mode.subscribe((mode) => void show(mode));
  void show(wb.posing.mode.get());
  return (character: Character | undefined, joints: readonly number[]) => {
    shown = [character, joints];
    if (wb.posing.mode.get() === 'rig') rows?.show(character, joints);
  };
}

/** Shown if the selected joint belongs to a limb, and loaded with the first. */
function limbSection(wb: Workbench, section: GUI): () => void {
  let rows: LimbSection | undefined;
  return () => {
    const isShown = selectedLimbs(wb) !== undefined;
    if (rows || !isShown) {
      section.show(isShown);
      rows?.update();
      return;
    }
    void onDemand(wb.messages, 'The Limb section', () => import('../limbs/limb-section.ts')).then((module) => {
      rows ??= module && new module.LimbSection(wb, section);
      rows?.update();
    });
  };
}

/** What the rows depend on, by identity. */
interface Shown {
  readonly id: string | undefined;
  /** Selected ones, the active one last. */
  readonly joints: readonly number[];
  readonly skeleton: Character['skeleton'];
  readonly morphs: Character['morphs'] | undefined;
  readonly clamps: boolean;
  readonly copies: number;
  readonly hasTake: boolean;
  readonly hasSamples: boolean;
  readonly isMoved: boolean;
  readonly isAttached: boolean;
  readonly angles: string;
}

function whatIsShown(wb: Uses<'store' | 'settings'>): Shown {
  const character = currentCharacter(wb);
  const { selection } = wb.store;
  return {
    id: character?.id,
    joints: selection.characterId === character?.id ? jointsIn(selection) : [],
    skeleton: character?.skeleton,
    morphs: character?.morphs,
    clamps: character?.clampsToLimits ?? true,
    copies: character?.placements.length ?? 0,
    hasTake: character !== undefined && shownTake(character) !== undefined,
    hasSamples: character !== undefined && shownTake(character)?.samples !== undefined,
    isMoved: character?.driver !== undefined,
    isAttached: character !== undefined && shownTake(character)?.attached !== undefined,
    angles: wb.settings.get().angles,
  };
}

/** A new take doesn't affect the sliders: the one being dragged while the first key is made must stay. */
function sameDofs(a: Shown, b: Shown): boolean {
  return (
    a.id === b.id &&
    sameJoints(a, b) &&
    a.skeleton === b.skeleton &&
    a.morphs === b.morphs &&
    a.clamps === b.clamps &&
    a.angles === b.angles
  );
}

function sameJoints({ joints: a }: Shown, { joints: b }: Shown): boolean {
  return a.length === b.length && a.every((joint, i) => joint === b[i]);
}

function sameCharacterRows(a: Shown, b: Shown): boolean {
  return (
    a.id === b.id &&
    a.skeleton === b.skeleton &&
    a.morphs === b.morphs &&
    a.copies === b.copies &&
    a.hasTake === b.hasTake &&
    a.hasSamples === b.hasSamples &&
    a.isMoved === b.isMoved &&
    a.isAttached === b.isAttached &&
    a.angles === b.angles
  );
}

/** Saves scroll position and focus; the returned function restores them after rows were rebuilt. */
function placeIn(scroller: HTMLElement): () => void {
  const { scrollTop } = scroller;
  const focused = document.activeElement;
  const row = focused?.closest<HTMLElement>('[data-dof]');
  const section = row?.closest('.lil-gui');
  return () => {
    if (row && !row.isConnected && document.activeElement === document.body) {
      const again = section?.querySelector<HTMLElement>(`[data-dof="${row.dataset.dof}"]`);
      again?.querySelector<HTMLElement>('input')?.focus({ preventScroll: true });
    }
    if (scroller.scrollTop !== scrollTop) scroller.scrollTop = scrollTop;
  };
}

/** A section whose open state is remembered. */
function rememberedSection(wb: Uses<'settings'>, gui: GUI, id: string, title: string, open: boolean): GUI {
  const key = `inspector/${id}`;
  const section = gui.addFolder(title);
  section.open(wb.settings.get().folds[key] ?? open);
  setAttribute(section.domElement, SECTION, id);
  wb.settings.subscribe(({ folds }, before) => {
    const opens = folds[key] ?? open;
    if (folds[key] !== before.folds[key] && isOpen(section) !== opens) section.open(opens);
  });
  section.onOpenClose((changed) => {
    if (changed !== section) return;
    wb.settings.update((s) => ({ ...s, folds: { ...s.folds, [key]: isOpen(section) } }));
  });
  return section;
}
