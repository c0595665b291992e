/** Actions of layers, on the active one of the shown take. Edits are loaded on first use. */
import { shownTake } from '../../../model/document.ts';
import type { Layer } from '../../../model/takes/take.ts';
import { currentCharacter } from '../../state/actions/action.ts';
import { needs, needsJoint } from '../../state/actions/needs.ts';
import { selectedJointsText } from '../../state/joints/selected-joint.ts';
import { onDemand } from '../../state/on-demand.ts';
import type { Action, Uses, Workbench } from '../../state/workbench.ts';
import { needsTake } from '../timeline/key-actions.ts';

const MENU = 'Keys/Layers';

/** The edits, on the shown take. */
async function edit(wb: Workbench, run: (edits: typeof import('./edits.ts')) => void): Promise<void> {
  const edits = await onDemand(wb.messages, 'Layers', () => import('./edits.ts'));
  if (edits) run(edits);
}

const stackOf = (wb: Uses<'store'>) => {
  const character = currentCharacter(wb);
  return character && shownTake(character)?.layers;
};

/** The active layer of the shown take. */
function activeOf(wb: Uses<'store'>): Layer | undefined {
  const stack = stackOf(wb);
  return stack?.list[stack.active];
}

const needsLayers = needs(
  (wb: Uses<'store'>) => needsTake(wb) ?? 'The take has no layers. Add one first.',
  (wb: Uses<'store'>) => stackOf(wb) !== undefined,
);
const needsActive = needs(
  (wb: Uses<'store'>) => needsLayers(wb) ?? 'The base is active. Click a layer in the list first.',
  (wb: Uses<'store'>) => activeOf(wb) !== undefined,
);
const needsActiveAndJoint = (wb: Uses<'store'>) => needsActive(wb) ?? needsJoint(wb);

/** An action on the active layer. */
function layer(
  id: string,
  label: string,
  run: (edits: typeof import('./edits.ts'), wb: Workbench) => void,
  more: Partial<Action>,
): Action {
  return {
    id: `layer.${id}`,
    label,
    group: 'Keys',
    menu: MENU,
    section: 4,
    refuses: needsActive,
    run: (wb) => edit(wb, (edits) => run(edits, wb)),
    ...more,
  };
}

export const LAYER_ACTIONS: readonly Action[] = [
  layer('add', 'Add layer', (edits, wb) => edits.add(wb), {
    also: 'animation layer additive gesture correct capture',
    detail: 'Poses and keys over the take, which stays as it is',
    refuses: needsTake,
  }),
  layer('addMasked', 'Add layer for selected joints', (edits, wb) => edits.add(wb, true), {
    label: (wb) => `Add layer for ${selectedJointsText(wb)}`,
    name: 'Add layer for selected joints',
    refuses: (wb) => needsTake(wb) ?? needsJoint(wb),
  }),
  layer('above', 'Edit layer above', (edits, wb) => edits.step(wb, 1), {
    section: 5,
    refuses: needsLayers,
    unchanged: 'The topmost layer is active.',
  }),
  layer('below', 'Edit layer below', (edits, wb) => edits.step(wb, -1), {
    section: 5,
    refuses: needsLayers,
    unchanged: 'The base is active.',
  }),
  layer('mute', 'Mute layer', (edits, wb) => edits.toggle(wb, 'mute'), {
    section: 6,
    panel: 'layers',
    shortcuts: ['M'],
    checked: (wb) => activeOf(wb)?.mute ?? false,
  }),
  layer('solo', 'Solo layer', (edits, wb) => edits.toggle(wb, 'solo'), {
    section: 6,
    panel: 'layers',
    shortcuts: ['S'],
    checked: (wb) => activeOf(wb)?.solo ?? false,
  }),
  layer('override', 'Layer overrides those below', (edits, wb) => edits.toggleMode(wb), {
    section: 6,
    checked: (wb) => activeOf(wb)?.mode === 'override',
  }),
  layer('keyWeight', 'Key weight of layer', (edits, wb) => edits.keyWeight(wb), { section: 6 }),
  layer('mask', 'Layer touches selected joints only', (edits, wb) => edits.mask(wb), {
    section: 6,
    label: (wb) => `Layer touches ${selectedJointsText(wb)} only`,
    name: 'Layer touches selected joints only',
    refuses: needsActiveAndJoint,
    unchanged: 'The layer already touches only these.',
  }),
  layer('raise', 'Move layer up', (edits, wb) => edits.move(wb, 1), {
    section: 7,
    unchanged: 'The layer is already the topmost.',
  }),
  layer('lower', 'Move layer down', (edits, wb) => edits.move(wb, -1), {
    section: 7,
    unchanged: 'The layer is already the lowest.',
  }),
  layer('mergeDown', 'Merge layer down', (edits, wb) => edits.mergeDown(wb), {
    section: 8,
    detail: 'Into the layer below or the base',
  }),
  layer('flatten', 'Flatten layers', (edits, wb) => edits.flatten(wb), {
    section: 8,
    detail: 'All of them into the take',
    refuses: needsLayers,
  }),
  layer('remove', 'Remove layer', (edits, wb) => edits.remove(wb), { section: 8 }),
];
