/**
 * Between what is shown and what the active layer has: while posing one sees the sum of all layers, and keys the value
 * of one, x = (wanted − a) / b, where the sum is a + b·x.
 */
import { type LayerShare, shareOf, touches } from '../../evaluate/layers.ts';
import { evaluateMotion, takeMotion } from '../../evaluate/take-motion.ts';
import { type Character, shownTake } from '../../model/document.ts';
import { activeLayer } from '../../model/takes/layers.ts';
import { CommandError } from '../command-error.ts';

/** Below this share of a layer in what is shown, no value of it shows what is wanted. */
const MIN_SHARE = 1e-6;

/** The share of the active layer, or of the base, in each DOF; undefined for a shown take without layers. */
export function activeShare(character: Character, timeSeconds: number): ((dof: number) => LayerShare) | undefined {
  const take = shownTake(character);
  if (!take?.layers) return undefined;
  const { skeleton, timeOffsetSeconds } = character;
  const time = timeSeconds + timeOffsetSeconds;
  const base = new Float64Array(take.channels.length);
  evaluateMotion({ ...takeMotion(take, skeleton), layers: undefined }, time, base, base.length);
  return shareOf(take, skeleton, take.layers.active, time, base);
}

/**
 * The values of the active layer with which the given ones are shown; the same without layers.
 * @param values by DOF, as they should be displayed
 * @throws CommandError, which names the layer, if no value of it shows one of them
 */
export function layerValues(
  character: Character,
  values: ReadonlyMap<number, number>,
  timeSeconds: number,
): ReadonlyMap<number, number> {
  const share = activeShare(character, timeSeconds);
  if (!share) return values;
  return new Map(
    [...values].map(([dof, wanted]) => {
      const { a, b } = share(dof);
      if (Math.abs(b) < MIN_SHARE) throw refused(character);
      return [dof, (wanted - a) / b + 0];
    }),
  );
}

/** Whether keys of the active layer can have an effect on a DOF, by the joints that it touches. */
export function touchedByActive(character: Character): (dof: number) => boolean {
  const take = shownTake(character);
  const layer = take && activeLayer(take);
  return layer ? touches(layer, character.skeleton) : () => true;
}

function refused(character: Character): CommandError {
  const take = shownTake(character);
  const layer = take && activeLayer(take);
  if (layer?.mute) {
    return new CommandError(
      `The layer "${layer.name}" is muted: keys there would not show. Unmute it, or choose another layer.`,
    );
  }
  const what = layer ? `Layer "${layer.name}"` : 'The base';
  return new CommandError(
    `${what} has no part in what is shown there: its weight, mute, solo, joints, or a layer above it keep it out.`,
  );
}
