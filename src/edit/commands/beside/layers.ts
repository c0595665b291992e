/**
 * Layers of the shown take. What is keyed and edited otherwise belongs to the active one, whose channels are the take's
 * (`model/takes/layers.ts`).
 */
import { provideLayers } from '../../../evaluate/layers.ts';
import { type Document, shownTake } from '../../../model/document.ts';
import { jointReferences } from '../../../model/skeleton/joint-reference.ts';
import { arranged, emptyMotion, LAYER_MODES, motionOf, unlayered, withActive } from '../../../model/takes/layers.ts';
import type { Layer, Take } from '../../../model/takes/take.ts';
import { TANGENT_KINDS } from '../../../model/takes/tangent-kinds.ts';
import { indexIn } from '../../arguments.ts';
import type { Edit } from '../../change.ts';
import { changeCharacter, requireCharacter } from '../../characters.ts';
import { command } from '../../command.ts';
import { CommandError } from '../../command-error.ts';
import { cutName, SHORT_NAME } from '../../cut-name.ts';
import { putKeyAt } from '../../keys/put-key.ts';
import { flattened } from '../../layers/flatten.ts';
import { mergedDown } from '../../layers/merge.ts';
import { boolean, filledText, index, oneOf, optional, shape, whole } from '../../schema/shape.ts';
import { CHARACTER, indices, NOW } from '../../schema/shared-shapes.ts';
import { requireTake, withChannels, withTake } from '../../takes.ts';
import { withoutUnkeyed } from '../../unkeyed.ts';

/** A layer of the shown take, by its index from the lowest up. */
const LAYER = { ...CHARACTER, layer: index } as const;
const mode = oneOf(LAYER_MODES);
const weight = shape('a number from 0 to 1', (value): value is number => {
  return typeof value === 'number' && value >= 0 && value <= 1;
});

/** Adds a layer above the others, which becomes active: posing and keying change it, and the rest of the take stays. */
export const addLayer = command({
  id: 'layers.add',
  args: {
    ...CHARACTER,
    name: optional(filledText),
    mode: optional(mode),
    /** The joints that it touches; default everything. */
    joints: optional(indices),
  },
  label: (_document, { name }) => (name === undefined ? 'Add layer' : `Add layer ${cutName(name)}`),
  run: (document, { characterId, name, mode: how = 'additive', joints }) =>
    changed(
      document,
      characterId,
      (take) => {
        const list = listOf(take);
        const called = name === undefined ? freeName(list) : unusedName(list, name, -1);
        const layer: Layer = {
          ...{ name: called, mode: how, weight: 1, mute: false, solo: false, root: false, morphs: false },
          ...(joints && { joints: referencesTo(document, characterId, joints) }),
          motion: emptyMotion(take.channels.length),
        };
        return arranged(take, motionOf(take, -1), [...list, layer], list.length);
      },
      'keeps unkeyed',
    ),
});

/** Removes a layer with its keys; without any left, the take is its base. */
export const removeLayer = command({
  id: 'layers.remove',
  args: LAYER,
  label: (document, of) => `Remove layer ${layerIn(document, of)}`,
  run: (document, { characterId, layer }) =>
    changed(document, characterId, (take) => {
      const list = requireLayers(take, layer);
      const active = take.layers?.active ?? -1;
      const left = list.filter((_, i) => i !== layer);
      if (left.length === 0) return unlayered(take, motionOf(take, -1));
      return arranged(take, motionOf(take, -1), left, active === layer ? -1 : active - (active > layer ? 1 : 0));
    }),
});

/** Renames a layer. */
export const renameLayer = command({
  id: 'layers.rename',
  args: { ...LAYER, name: filledText },
  label: (document, { name, ...of }) =>
    `Rename layer ${layerIn(document, of, SHORT_NAME)} to ${cutName(name, SHORT_NAME)}`,
  run: (document, { characterId, layer, name }) =>
    changed(document, characterId, (take) => {
      const list = requireLayers(take, layer);
      if (list[layer].name === name) return take;
      const { file: _file, ...own } = list[layer];
      return withList(take, list.with(layer, { ...own, name: unusedName(list, name, layer) }));
    }),
});

/** Sets how a layer takes part: its weight for all times, and what it touches. */
export const setLayer = command({
  id: 'layers.set',
  args: {
    ...LAYER,
    mode: optional(mode),
    weight: optional(weight),
    mute: optional(boolean),
    solo: optional(boolean),
    joints: optional(indices),
    root: optional(boolean),
    morphs: optional(boolean),
  },
  label: (document, { mute, solo, ...of }) => {
    const verb =
      mute === undefined ? (solo === undefined ? 'Set' : solo ? 'Solo' : 'Unsolo') : mute ? 'Mute' : 'Unmute';
    return `${verb} layer ${layerIn(document, of)}`;
  },
  run: (document, { characterId, layer, joints, ...given }) =>
    changed(document, characterId, (take) => {
      const list = requireLayers(take, layer);
      const set = {
        ...Object.fromEntries(Object.entries(given).filter(([, value]) => value !== undefined)),
        ...(joints && { joints: referencesTo(document, characterId, joints) }),
      };
      const before = list[layer];
      const { ofWeight, ...rest } = before;
      const next = wholeMask(document, characterId, {
        ...(given.weight === undefined && ofWeight ? before : rest),
        ...set,
      });
      const isSame = JSON.stringify({ ...next, motion: 0 }) === JSON.stringify({ ...before, motion: 0 });
      return isSame ? take : withList(take, list.with(layer, next));
    }),
});

/** Keys the weight of a layer at a time. */
export const keyLayerWeight = command({
  id: 'layers.keyWeight',
  args: { ...NOW, layer: index, weight },
  label: (document, of) => `Key weight of layer ${layerIn(document, of)}`,
  run: (document, { characterId, layer, weight: value, timeSeconds }) => {
    const time = timeSeconds + requireCharacter(document, characterId).timeOffsetSeconds;
    return changed(document, characterId, (take) => {
      const list = requireLayers(take, layer);
      const { weight: before } = list[layer];
      const smooth = TANGENT_KINDS.indexOf('auto');
      const from = typeof before === 'number' ? emptyMotion(1).channels[0] : before;
      const { channel } = putKeyAt(from, time, value, smooth, { outsideCycle: 'lengthen' });
      return channel === before ? take : withList(take, list.with(layer, { ...list[layer], weight: channel }));
    });
  },
});

/** Moves a layer to another place in the order. */
export const moveLayer = command({
  id: 'layers.move',
  args: { ...LAYER, to: index },
  label: (document, of) => `Move layer ${layerIn(document, of)}`,
  run: (document, { characterId, layer, to }) =>
    changed(document, characterId, (take) => {
      const list = requireLayers(take, layer);
      indexIn(to, 0, list.length, 'layer');
      if (to === layer) return take;
      const order = [...list.keys()].toSpliced(layer, 1).toSpliced(to, 0, layer);
      const active = take.layers?.active ?? -1;
      return arranged(
        take,
        motionOf(take, -1),
        order.map((i) => list[i]),
        active < 0 ? -1 : order.indexOf(active),
      );
    }),
});

/** Makes a layer active, or the base by -1: its keys are shown, and posing changes it. */
export const activateLayer = command({
  id: 'layers.activate',
  isNoStep: true,
  args: { ...CHARACTER, layer: whole(-1) },
  label: (document, of) => (of.layer < 0 ? 'Edit base' : `Edit layer ${layerIn(document, of)}`),
  run: (document, { characterId, layer }) =>
    changed(
      document,
      characterId,
      (take) => {
        indexIn(layer, -1, listOf(take).length, 'layer');
        return withActive(take, layer);
      },
      'keeps unkeyed',
    ),
});

/** Replaces a layer and the one beneath it, or the base, by their flattened sum. */
export const mergeLayerDown = command({
  id: 'layers.mergeDown',
  args: LAYER,
  label: (document, of) => `Merge layer ${layerIn(document, of)} down`,
  run: (document, { characterId, layer }) =>
    changed(document, characterId, (take) => {
      requireLayers(take, layer);
      return mergedDown(take, requireCharacter(document, characterId).skeleton, layer);
    }),
});

/** Replaces all layers by their sum: the take moves the same, in its own channels. */
export const flattenLayers = command({
  id: 'layers.flatten',
  args: CHARACTER,
  label: (document, { characterId }) =>
    `Flatten layers of ${cutName(shownTake(requireCharacter(document, characterId))?.name ?? 'take')}`,
  run: (document, { characterId }) =>
    changed(document, characterId, (take) => {
      if (!take.layers) throw new CommandError(`${take.name} has no layers.`);
      return flattened(take, requireCharacter(document, characterId).skeleton).take;
    }),
});

/**
 * The document with another shown take; selected keys were of the one before.
 * @param unkeyed whether unkeyed changes stay, as values that are to be shown, and go into the layer that is then
 *   active
 */
function changed(
  document: Document,
  characterId: string,
  change: (take: Take) => Take,
  unkeyed?: 'keeps unkeyed',
): Document | Edit {
  provideLayers();
  const before = requireCharacter(document, characterId);
  requireTake(before);
  const taking = withChannels(before, [0, 1]);
  const next = changeCharacter(document, characterId, () => {
    const take = requireTake(taking);
    const made = change(take);
    return made === take ? before : withTake(unkeyed ? taking : withoutUnkeyed(taking), taking.shownTake, made);
  });
  if (next === document) return document;
  const isOther = shownTake(requireCharacter(next, characterId))?.channels !== shownTake(before)?.channels;
  return isOther ? { document: next, keys: [] } : next;
}

/** The layers with their motions. */
function listOf(take: Take): readonly Layer[] {
  return take.layers?.list.map((layer, i) => ({ ...layer, motion: motionOf(take, i) })) ?? [];
}

function requireLayers(take: Take, layer: number): readonly Layer[] {
  if (!take.layers) throw new CommandError(`${take.name} has no layers.`);
  indexIn(layer, 0, take.layers.list.length, 'layer');
  return listOf(take);
}

function withList(take: Take, list: readonly Layer[]): Take {
  return arranged(take, motionOf(take, -1), list, take.layers?.active ?? -1);
}

function layerIn(
  document: Document,
  { characterId, layer }: { readonly characterId: string; readonly layer: number },
  length?: number,
): string {
  const take = shownTake(requireCharacter(document, characterId));
  return cutName(take?.layers?.list[layer]?.name ?? String(layer), length);
}

/** A layer that touches every joint, root and morphs touches everything, and names nothing. */
function wholeMask(document: Document, characterId: string, layer: Layer): Layer {
  const count = requireCharacter(document, characterId).skeleton?.joints.length;
  if (!layer.root || !layer.morphs || new Set(layer.joints).size !== count) return layer;
  const { joints: _joints, ...rest } = layer;
  return { ...rest, root: false, morphs: false };
}

function referencesTo(document: Document, characterId: string, joints: readonly number[]): readonly string[] {
  const { skeleton } = requireCharacter(document, characterId);
  const names = jointReferences(skeleton?.joints ?? []);
  return joints.map((joint) => names[indexIn(joint, 0, names.length, 'joint')]);
}

function freeName(list: readonly Layer[]): string {
  for (let n = 1; ; n++) {
    const name = n === 1 ? 'layer' : `layer ${n}`;
    if (!list.some((layer) => layer.name.toLowerCase() === name)) return name;
  }
}

/** @throws CommandError if another layer has the name: they are parts of the names of files */
function unusedName(list: readonly Layer[], name: string, own: number): string {
  if (list.some((layer, i) => i !== own && layer.name.toLowerCase() === name.toLowerCase())) {
    throw new CommandError(`Another layer is called "${cutName(name)}".`);
  }
  return name;
}
