/** Actions of the posing modes, and keys that only the viewport has. */
import { NOTHING_SELECTED } from '../../../model/session.ts';
import { needs } from '../../state/actions/needs.ts';
import type { PosingMode } from '../../state/posing.ts';
import { GIZMO_SCALES } from '../../state/settings.ts';
import type { Action, Uses, Workbench } from '../../state/workbench.ts';
import { activeDof, chooseNextDof, nudgeDof } from './active-dof.ts';

/** Factor of the gizmo's size for one key press: three double it. */
const GIZMO_STEP = 2 ** (1 / 3);
const NO_GIZMO = 'Only Pose, FK and IK modes have a gizmo.';
const GIZMO_MODES: readonly PosingMode[] = ['pose', 'fk', 'ik'];
const hasGizmo = ({ posing }: Uses<'posing'>) => GIZMO_MODES.includes(posing.mode.get());
/** Modes that turn the DOFs of the selected joint. */
const hasDofs = ({ posing }: Uses<'posing'>) => posing.mode.get() === 'pose' || posing.mode.get() === 'fk';

export const POSING_ACTIONS: readonly Action[] = [
  mode('select', 'Select (no gizmo)'),
  mode('pose', 'Pose: drag hands, feet and heads', ['W'], 'raise lift move arm leg body'),
  mode('fk', 'Forward kinematics (FK)'),
  mode('ik', 'Inverse kinematics (IK)'),
  mode('rig', 'Rig', ['Shift+E']),
  {
    id: 'posing.toggle',
    name: 'Switch between FK and IK',
    label: (wb) => (nextKinematics(wb.posing.mode.get()) === 'ik' ? 'Switch to IK' : 'Switch to FK'),
    group: 'Pose',
    menu: 'Edit/Mode',
    section: 1,
    shortcuts: ['E'],
    run: switchKinematics,
  },
  {
    id: 'posing.selectTool',
    name: 'Select tool (no gizmo), and back',
    label: (wb) => (wb.posing.mode.get() === 'select' ? 'Leave select tool' : 'Select tool (no gizmo)'),
    group: 'Pose',
    menu: 'Edit/Mode',
    section: 1,
    shortcuts: ['Q'],
    run: switchSelect,
  },
  {
    id: 'posing.leave',
    label: 'Leave rig mode or the select tool, or deselect all',
    group: 'Pose',
    shortcuts: ['Escape'],
    quiet: true,
    // During a drag, Escape is handled by `canvas-tools.ts`: this runs otherwise, and one press too many to cancel a
    // drag must not end IK.
    run(wb) {
      if (wb.posing.mode.get() === 'rig') wb.posing.mode.set('pose');
      else if (wb.posing.mode.get() === 'select') switchSelect(wb);
      else deselect(wb);
    },
  },
  dofKey('posing.nextDof', 'Next DOF of joint', ['V'], (wb) => chooseNextDof(wb, 1)),
  dofKey('posing.previousDof', 'Previous DOF of joint', ['Shift+V'], (wb) => chooseNextDof(wb, -1)),
  dofKey('posing.more', 'Increase active DOF by a step', ['+', '='], (wb) => nudgeDof(wb, 1)),
  dofKey('posing.less', 'Decrease active DOF by a step', ['-'], (wb) => nudgeDof(wb, -1)),
  gizmoSize('larger', 'Larger gizmo', ']', GIZMO_STEP),
  gizmoSize('smaller', 'Smaller gizmo', '[', 1 / GIZMO_STEP),
];

/** Of several joints the active one stays, once. */
function deselect({ store }: Uses<'store'>): void {
  const { selection } = store;
  const { others, ...active } = selection;
  if (others) store.select(active);
  else if (selection.characterId !== undefined) store.select(NOTHING_SELECTED);
}

export function switchKinematics(wb: Uses<'posing'>): void {
  wb.posing.mode.update(nextKinematics);
}

/** From FK and Pose to IK; from any other mode to FK. */
export function nextKinematics(now: PosingMode): 'fk' | 'ik' {
  return now === 'fk' || now === 'pose' ? 'ik' : 'fk';
}

/** To the select tool, and back to the mode before. */
function switchSelect({ posing }: Uses<'posing'>): void {
  posing.mode.update((now) => (now === 'select' ? posing.modeBeforeSelect : 'select'));
}

function mode(to: PosingMode, label: string, shortcuts?: readonly string[], also?: string): Action {
  return {
    id: `posing.${to}`,
    label,
    group: 'Pose',
    menu: 'Edit/Mode',
    section: 1,
    radio: true,
    ...(shortcuts && { shortcuts }),
    ...(also !== undefined && { also }),
    checked: (wb) => wb.posing.mode.get() === to,
    run: (wb) => wb.posing.mode.set(to),
  };
}

function dofKey(id: string, label: string, shortcuts: readonly string[], run: (wb: Workbench) => void): Action {
  const refuses = needs(
    (wb: Uses<'store' | 'posing'>) =>
      hasDofs(wb) ? 'Select a joint with DOFs first.' : 'DOFs are rotated in Pose and FK modes.',
    (wb: Uses<'store' | 'posing'>) => hasDofs(wb) && activeDof(wb) !== undefined,
  );
  return {
    id,
    label,
    also: 'rotate turn bend raise lift joint',
    group: 'Pose',
    shortcuts,
    panel: 'viewport',
    repeats: true,
    refuses,
    run,
  };
}

function gizmoSize(what: 'larger' | 'smaller', label: string, key: string, factor: number): Action {
  const [min, max] = GIZMO_SCALES;
  const next = (now: number) => Math.min(max, Math.max(min, now * factor));
  return {
    id: `gizmo.${what}`,
    label,
    group: 'Pose',
    menu: 'View/Gizmo',
    section: 3,
    shortcuts: [key],
    repeats: true,
    refuses: needs(
      (wb) =>
        hasGizmo(wb) ? `The gizmo is already as ${what === 'larger' ? 'large' : 'small'} as it gets.` : NO_GIZMO,
      (wb) => hasGizmo(wb) && next(wb.settings.get().gizmoScale) !== wb.settings.get().gizmoScale,
    ),
    explained: true,
    run: (wb) => wb.settings.update((s) => ({ ...s, gizmoScale: next(s.gizmoScale) })),
  };
}
