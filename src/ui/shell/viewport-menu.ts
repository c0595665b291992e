/**
 * The viewport's context menu: of the joint, pin or character under the pointer, which is selected first, or of the
 * background. By keyboard that of the selected joint. Loaded on first use.
 */
import { ikOf } from '../../evaluate/ik/set-up.ts';
import { transformPoint } from '../../math/vec3.ts';
import type { Character } from '../../model/document.ts';
import { JOINT_TEXTS } from '../../model/joint-types/texts.ts';
import type { Selection } from '../../model/session.ts';
import { withJointToggled } from '../../model/skeleton/joint-selection.ts';
import { isOffered, MOTION_KINDS } from '../../model/skeleton/joint-types.ts';
import { jointsIn, partOf, partsOf } from '../../model/skeleton/selected-joints.ts';
import { changePin, stiffen } from '../editors/ik/pin-edits.ts';
import { selectedPin } from '../editors/ik/selected-pin.ts';
import type { CanvasPointer } from '../editors/viewport/canvas-tools.ts';
import { currentCharacter } from '../state/actions/action.ts';
import { menuEntries, sectionsOf } from '../state/actions/menu-entries.ts';
import { activateJoint } from '../state/joints/select-joints.ts';
import { allJointsText, type ResolvedJoint, selectedJoint, selectedJointsOf } from '../state/joints/selected-joint.ts';
import type { Uses, Workbench } from '../state/workbench.ts';
import { type MenuEntry, openMenu } from '../widgets/menu.ts';
import { shown } from '../widgets/numbers/number-text.ts';

/** What a menu is about. */
export type MenuSubject = 'joint' | 'character' | 'background';

type Hit = ReturnType<Workbench['viewport']['pointing']['pick']>;

/**
 * Selects what was hit, unless it is selected already; one of several selected joints becomes active. Nothing hit: the
 * selection stays.
 */
export function selectForMenu(wb: Uses<'store'>, hit: Hit): MenuSubject {
  if (!hit) return 'background';
  const { characterId, placement, joint } = hit;
  const { selection } = wb.store;
  if (selection.characterId === characterId && selection.joint === joint) return subjectOf(wb);
  if (joint === undefined) wb.store.select(hit);
  else activateJoint(wb, { characterId, placement, joint });
  return subjectOf(wb);
}

/** What is selected. */
export function subjectOf(wb: Uses<'store'>): MenuSubject {
  if (selectedJoint(wb)) return 'joint';
  return wb.store.selection.characterId === undefined ? 'background' : 'character';
}

/** Opens the menu at the pointer. @param isSelected the mode's tool has selected what is there */
export function openMenuAt(wb: Workbench, at: CanvasPointer, isSelected: boolean): void {
  const { clientX: x, clientY: y } = at;
  const before = wb.store.selection;
  const subject = isSelected ? subjectOf(wb) : selectForMenu(wb, wb.viewport.pointing.pick(x, y));
  open(wb, subject, { x, y }, false, before);
}

/** Opens the menu of the selection beside it. */
export function openMenuByKey(wb: Workbench): void {
  const subject = subjectOf(wb);
  open(wb, subject, placeByKey(wb, subject), true, wb.store.selection);
}

function open(
  wb: Workbench,
  subject: MenuSubject,
  at: { readonly x: number; readonly y: number },
  byKey: boolean,
  before: Selection,
) {
  const name = subject === 'joint' ? allJointsText(wb) : currentCharacter(wb)?.name;
  const label = subject === 'background' || name === undefined ? 'Viewport' : name;
  openMenu(at, viewportEntries(wb, subject, before), { label, opener: wb.viewport.canvas, focusFirst: byKey });
}

/**
 * The entries for a subject in the current mode.
 *
 * @param before the selection when the menu was asked for, to which the joint can be added
 */
export function viewportEntries(wb: Workbench, subject: MenuSubject, before?: Selection): MenuEntry[] {
  const selected = subject === 'joint' ? selectedJoint(wb) : undefined;
  if (selected)
    return [titleOf(allJointsText(wb)), ...addingEntries(wb, selected, before), ...jointEntries(wb, selected)];
  const character = subject === 'character' ? currentCharacter(wb) : undefined;
  if (character) return [titleOf(character.name), ...sectionsOf(wb, CHARACTER)];
  return backgroundEntries(wb);
}

/** A finger has no Shift or Ctrl. */
function addingEntries(wb: Uses<'store'>, { character, joint }: ResolvedJoint, before?: Selection): MenuEntry[] {
  const { selection } = wb.store;
  const isOne = partsOf(selection).flatMap(jointsIn).length > 1;
  const from = isOne ? selection : before;
  const isOther = from && from.joint !== undefined && !jointsIn(partOf(from, character.id) ?? {}).includes(joint);
  if (!from || !(isOne || isOther)) return [];
  const { placement } = selection;
  const pick = { characterId: character.id, joint, ...(placement !== undefined && { placement }) };
  return [
    {
      kind: 'item',
      label: isOne ? 'Remove from selection' : 'Add to selection',
      enabled: true,
      run: () => wb.store.select(withJointToggled(from, pick)),
    },
    { kind: 'line' },
  ];
}

function titleOf(text: string): MenuEntry {
  return { kind: 'note', text };
}

const FRAMING = ['view.frameSelection', 'draw.follow', 'draw.trail'];
const LOOKING_UP = ['timeline.jointCurves', 'page.details'];
const MODE = ['Edit/Mode'];

function jointEntries(wb: Workbench, selected: ResolvedJoint): MenuEntry[] {
  switch (wb.posing.mode.get()) {
    case 'ik':
      return sectionsOf(wb, [
        ['ik.pinJoint', ...pinEntries(wb, selected)],
        ['ik.lockJoint', stiffnessMenu(wb, selected), 'Edit/Pins'],
        ['key.joint', 'pose.resetJoints'],
        ['view.frameSelection', ...LOOKING_UP],
        MODE,
      ]);
    case 'rig':
      return sectionsOf(wb, [
        ['rigging.addChild', 'rigging.addJoints'],
        ['rigging.rename', typeMenu(wb, selected), 'Rig/Mirror hierarchy'],
        ['rigging.delete', 'rigging.deleteBranch'],
        ['view.frameSelection', 'page.details'],
        MODE,
      ]);
    case 'pose':
    case 'fk':
    case 'select':
      return sectionsOf(wb, [
        ['key.joint', 'key.deleteJointHere'],
        ['pose.resetJoints', 'Edit/Pose', 'pose.holdLimits'],
        FRAMING,
        LOOKING_UP,
        MODE,
      ]);
  }
}

const CHARACTER = [
  ['view.frameSelection', 'character.hide'],
  ['key.pose', 'pose.resetToFile', 'Edit/Pose'],
  ['character.copy', 'file.reload', 'save.list', 'character.remove'],
  MODE,
];

function backgroundEntries(wb: Workbench): MenuEntry[] {
  const examples: MenuEntry = { kind: 'menu', label: 'Examples', entries: () => menuEntries(wb, 'Examples') };
  return sectionsOf(wb, [
    ['file.open', examples, wb.posing.mode.get() === 'rig' ? 'rigging.addJoints' : 'rigging.new'],
    ['view.frameAll', 'View/Camera'],
    ['View/Skin', 'View/Boxes', 'draw.grid', 'draw.shadow', 'View/Theme'],
    [...MODE, 'select.nothing'],
  ]);
}

/** Of the selected pin, else the first one of the joint. */
function pinEntries(wb: Workbench, { character, joint }: ResolvedJoint): MenuEntry[] {
  const own = ikOf(character).pins.find((pin) => pin.joint === joint);
  const chosen = selectedPin(wb);
  const pin = chosen?.character === character ? chosen.pin : own;
  if (!pin) return [];
  const ref = { characterId: character.id, pin: pin.id };
  const { holdsOrientation } = pin;
  return [
    {
      kind: 'item',
      label: 'Pin orientation',
      checked: holdsOrientation,
      enabled: true,
      run: () => changePin(wb, ref, { holdsOrientation: !holdsOrientation }),
    },
    radioMenu('Relative weight', WEIGHTS, pin.weight, shown, (weight) => changePin(wb, ref, { weight })),
  ];
}

const WEIGHTS = [0.25, 0.5, 1, 2, 4];

const STIFFNESSES = ['usual', 2, 4, 8, 'locked'] as const;
const STIFFNESS_NAMES = { usual: 'Default', locked: 'Locked' } as const;

function stiffnessMenu(wb: Workbench, { character, joint }: ResolvedJoint): MenuEntry {
  const own = ikOf(character).stiff.find((one) => one.joint === joint);
  const now = own ? (own.stiffness ?? 'locked') : 'usual';
  const name = (value: number | 'usual' | 'locked') =>
    typeof value === 'number' ? shown(value) : STIFFNESS_NAMES[value];
  return radioMenu('Stiffness', STIFFNESSES, now, name, (next) =>
    stiffen(wb, character.id, selectedJointsOf(wb, character.id), next),
  );
}

/** Types of captures are only offered to joints that have them. */
function typeMenu(wb: Workbench, { skeleton, joint }: ResolvedJoint): MenuEntry {
  const { motion } = skeleton.joints[joint];
  const kinds = MOTION_KINDS.filter((kind) => kind === motion.kind || isOffered(kind));
  const name = (kind: (typeof MOTION_KINDS)[number]) => JOINT_TEXTS[kind].label;
  return radioMenu('Type', kinds, motion.kind, name, (kind) => {
    void import('../editors/rig/rig-edits.ts').then((module) => module.setType(wb, kind));
  });
}

function radioMenu<T>(
  label: string,
  values: readonly T[],
  now: T,
  name: (value: T) => string,
  run: (value: T) => void,
): MenuEntry {
  const entries = () =>
    values.map(
      (value): MenuEntry => ({
        kind: 'item',
        label: name(value),
        radio: true,
        checked: value === now,
        enabled: true,
        run: () => run(value),
      }),
    );
  return { kind: 'menu', label, entries };
}

/** Beside the selected joint if it is visible, else in the middle of the viewport. */
function placeByKey(wb: Workbench, subject: MenuSubject): { readonly x: number; readonly y: number } {
  const { left, right, top, bottom } = wb.viewport.canvas.getBoundingClientRect();
  const selected = subject === 'joint' ? selectedJoint(wb) : undefined;
  const seen = selected && onScreen(wb, selected.character, selected.joint);
  const isVisible =
    seen && seen.depth > 0 && seen.x > left && seen.x < right && seen.y > top && seen.y < bottom ? seen : undefined;
  return isVisible ? { x: isVisible.x + BESIDE, y: isVisible.y } : { x: (left + right) / 2, y: (top + bottom) / 2 };
}

/** Pixels from a joint to its menu. */
const BESIDE = 16;

function onScreen({ viewport }: Uses<'viewport'>, character: Character, joint: number) {
  const world = viewport.character(character.id)?.worlds;
  const toScene = viewport.placementOf(character.id, viewport.pickedCopy(character));
  if (!world || toScene?.length !== 16 || 16 * joint >= world.length) return undefined;
  const o = 16 * joint + 12;
  return viewport.eye.toScreen(transformPoint(toScene, [world[o], world[o + 1], world[o + 2]]));
}
