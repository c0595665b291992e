/** Edits of the shown take's layers, for menus, keys and the list. Loaded on first use. */

import { documentIn } from '../../../edit/change.ts';
import type { ArgsOf } from '../../../edit/command.ts';
import {
  activateLayer,
  addLayer,
  flattenLayers,
  keyLayerWeight,
  mergeLayerDown,
  moveLayer,
  removeLayer,
  renameLayer,
  setLayer,
} from '../../../edit/commands/beside/layers.ts';
import { keyPose } from '../../../edit/commands/keying.ts';
import { cutName } from '../../../edit/cut-name.ts';
import { type Character, shownTake } from '../../../model/document.ts';
import { type LayerInfo, layerCode } from '../../../model/takes/layer-code.ts';
import { activeLayer } from '../../../model/takes/layers.ts';
import { currentCharacter } from '../../state/actions/action.ts';
import { attempt } from '../../state/actions/attempt.ts';
import type { HandEdit } from '../../state/actions/hand-edit.ts';
import { selectedJointsOf } from '../../state/joints/selected-joint.ts';
import type { Uses } from '../../state/workbench.ts';

type Parts = Uses<'store' | 'messages'>;
type Timed = Parts & Uses<'transport'>;

/** The layers of the shown take now, from the lowest up; empty without any. */
export function layersNow(character: Character | undefined, timeSeconds: number): readonly LayerInfo[] {
  const take = character && shownTake(character);
  if (!character || !take?.layers) return [];
  return layerCode(take).infos(take, timeSeconds + character.timeOffsetSeconds);
}

/** Adds a layer above the others, which becomes active. @param masked for the selected joints alone */
export function add(wb: Parts, masked = false): void {
  const character = currentCharacter(wb);
  if (!character) return;
  const joints = masked ? selectedJointsOf(wb, character.id) : [];
  const before = wb.store.document;
  apply(wb, (characterId) => wb.store.apply(addLayer, { characterId, ...(joints.length > 0 && { joints }) }));
  if (wb.store.document !== before) tellActive(wb);
}

function tellActive(wb: Parts): void {
  const take = takeNow(wb);
  const made = take && activeLayer(take);
  if (!made) return;
  wb.messages.note(
    `Layer “${cutName(made.name)}” is active: poses and keys go into it, and ${take.name} stays below as it is.`,
  );
}

/** Adds a layer and keys DOFs in it as they are displayed, in one step. */
export function addAndKey(wb: Parts, args: ArgsOf<typeof keyPose>): void {
  const { store, messages } = wb;
  attempt(messages, () => {
    const { characterId } = args;
    const keyed = keyPose.run(documentIn(addLayer.run(store.document, { characterId })), args);
    const step = store.begin(keyPose.label(store.document, args));
    step.preview(keyed);
    step.commit();
  });
}

/** Makes another layer active, or the base by −1. */
export function activate(wb: Parts, layer: number): void {
  apply(wb, (characterId) => wb.store.apply(activateLayer, { characterId, layer }));
}

/** To the layer above or below the active one. */
export function step(wb: Parts, by: 1 | -1): void {
  const stack = takeNow(wb)?.layers;
  const to = (stack?.active ?? -1) + by;
  if (stack && to >= -1 && to < stack.list.length) activate(wb, to);
}

/** Mutes or solos a layer, or ends that. */
export function toggle(wb: Parts, what: 'mute' | 'solo', layer: number = activeIndex(wb)): void {
  const one = takeNow(wb)?.layers?.list[layer];
  if (one) apply(wb, (characterId) => wb.store.apply(setLayer, { characterId, layer, [what]: !one[what] }));
}

/** From additive to override, or back. */
export function toggleMode(wb: Parts, layer: number = activeIndex(wb)): void {
  const one = takeNow(wb)?.layers?.list[layer];
  if (one)
    apply(wb, (characterId) =>
      wb.store.apply(setLayer, { characterId, layer, mode: one.mode === 'additive' ? 'override' : 'additive' }),
    );
}

/** Keys the weight that a layer has at the current time. */
export function keyWeight(wb: Timed, layer: number = activeIndex(wb)): void {
  const { timeSeconds } = wb.transport.get();
  const weight = layersNow(currentCharacter(wb), timeSeconds)[layer]?.weight;
  if (weight !== undefined)
    apply(wb, (characterId) => wb.store.apply(keyLayerWeight, { characterId, layer, timeSeconds, weight }));
}

/** The weight for all times, in place of its keys: what it is at the current time. */
export function unkeyWeight(wb: Timed, layer: number): void {
  const weight = layersNow(currentCharacter(wb), wb.transport.get().timeSeconds)[layer]?.weight;
  if (weight !== undefined) apply(wb, (characterId) => wb.store.apply(setLayer, { characterId, layer, weight }));
}

/** Shows a weight within a gesture: keyed at the current time where the weight has keys. */
export function previewWeight(wb: Timed, edit: HandEdit, layer: number, weight: number): void {
  const character = currentCharacter(wb);
  const one = character && shownTake(character)?.layers?.list[layer];
  if (!character || !one) return;
  const { id: characterId } = character;
  const { timeSeconds } = wb.transport.get();
  if (typeof one.weight === 'number') edit.preview(setLayer, { characterId, layer, weight });
  else edit.preview(keyLayerWeight, { characterId, layer, timeSeconds, weight });
}

/** Lets a layer touch the selected joints alone. */
export function mask(wb: Parts, layer: number = activeIndex(wb)): void {
  const character = currentCharacter(wb);
  if (character)
    apply(wb, (characterId) =>
      wb.store.apply(setLayer, { characterId, layer, joints: selectedJointsOf(wb, character.id) }),
    );
}

/** Lets a layer touch everything. */
export function unmask(wb: Parts, layer: number): void {
  const joints = currentCharacter(wb)?.skeleton?.joints ?? [];
  const all = { joints: [...joints.keys()], root: true, morphs: true };
  apply(wb, (characterId) => wb.store.apply(setLayer, { characterId, layer, ...all }));
}

/** Lets a layer touch the root translation, or morphs, besides its joints, or not. */
export function toggleTouched(wb: Parts, layer: number, what: 'root' | 'morphs'): void {
  const one = takeNow(wb)?.layers?.list[layer];
  if (one) apply(wb, (characterId) => wb.store.apply(setLayer, { characterId, layer, [what]: !one[what] }));
}

/** Moves a layer up or down by one. */
export function move(wb: Parts, by: 1 | -1): void {
  const layer = activeIndex(wb);
  const count = takeNow(wb)?.layers?.list.length ?? 0;
  if (layer >= 0 && layer + by >= 0 && layer + by < count) moveTo(wb, layer, layer + by);
}

/** Moves a layer to a place in the order, from the lowest up. */
export function moveTo(wb: Parts, layer: number, to: number): void {
  apply(wb, (characterId) => wb.store.apply(moveLayer, { characterId, layer, to }));
}

/** Names a layer; a blank name changes nothing. */
export function rename(wb: Parts, layer: number, name: string): void {
  if (name.trim() !== '')
    apply(wb, (characterId) => wb.store.apply(renameLayer, { characterId, layer, name: name.trim() }));
}

/** Replaces a layer and what is below it by their sum. */
export function mergeDown(wb: Parts, layer: number = activeIndex(wb)): void {
  apply(wb, (characterId) => wb.store.apply(mergeLayerDown, { characterId, layer }));
}

/** Replaces all layers by their sum. */
export function flatten(wb: Parts): void {
  apply(wb, (characterId) => wb.store.apply(flattenLayers, { characterId }));
}

/** Removes a layer with its keys. */
export function remove(wb: Parts, layer: number = activeIndex(wb)): void {
  apply(wb, (characterId) => wb.store.apply(removeLayer, { characterId, layer }));
}

function takeNow(wb: Uses<'store'>) {
  const character = currentCharacter(wb);
  return character && shownTake(character);
}

function activeIndex(wb: Uses<'store'>): number {
  return takeNow(wb)?.layers?.active ?? -1;
}

/** Applies a command to the current character. */
function apply(wb: Parts, change: (characterId: string) => void): void {
  const character = currentCharacter(wb);
  if (character) attempt(wb.messages, () => change(character.id));
}
