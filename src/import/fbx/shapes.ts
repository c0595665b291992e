/**
 * The blend shapes of an FBX mesh: channels with a percentage, each with one shape, or several at ascending percentages
 * between which it blends.
 */
import { type FbxDocument, type FbxObject, partsOfKind } from './document.ts';
import { childOf, type FbxNumbers, numberAt, numbersOf } from './records/record.ts';

/** A channel of blend shapes. */
export interface FbxChannel {
  readonly object: FbxObject;
  readonly name: string;
  /** At rest. */
  readonly percent: number;
  /** By ascending percentage. */
  readonly shapes: readonly FbxShape[];
}

/** A blend shape: what it adds to points. */
export interface FbxShape {
  readonly name: string;
  /** The percentage at which it is full. */
  readonly full: number;
  /** Points, and x y z added to each. */
  readonly points: FbxNumbers;
  readonly offsets: FbxNumbers;
  /** x y z added to the normal of each; empty if the file has none. */
  readonly normals: FbxNumbers;
}

/** The channels of a geometry, in the order of the file. */
export function channelsOf(document: FbxDocument, geometry: FbxObject): FbxChannel[] {
  return partsOfKind(document, geometry, 'Deformer', 'BlendShape')
    .flatMap((blend) => partsOfKind(document, blend, 'Deformer', 'BlendShapeChannel'))
    .map((object) => {
      const shapes = partsOfKind(document, object, 'Geometry', 'Shape');
      const full = numbersOf(childOf(object.record, 'FullWeights'));
      const arePointWeights = shapes.length === 1 && isOfPoints(document, shapes[0], full);
      return {
        object,
        name: object.name || shapes[0]?.name || '',
        // Blender has it as a record.
        percent: object.properties.number('DeformPercent') ?? numberAt(childOf(object.record, 'DeformPercent')) ?? 0,
        shapes: shapes
          .map(({ name, record }, i) => {
            const weighed = (numbers: FbxNumbers) => (arePointWeights ? weighedBy(full, numbers) : numbers);
            return {
              name,
              full: (!arePointWeights && full.length === shapes.length && full[i]) || 100,
              points: numbersOf(childOf(record, 'Indexes')),
              offsets: weighed(numbersOf(childOf(record, 'Vertices'))),
              normals: weighed(numbersOf(childOf(record, 'Normals'))),
            };
          })
          .sort((a, b) => a.full - b.full),
      };
    });
}

/**
 * Whether the `FullWeights` of a channel are percentages by which the points of its only shape follow it, as Blender
 * writes those of a vertex group. A single number is one only there: elsewhere it is the percentage of the whole shape.
 */
function isOfPoints({ isOfBlender }: FbxDocument, { record }: FbxObject, full: FbxNumbers): boolean {
  const count = numbersOf(childOf(record, 'Indexes')).length;
  return full.length === count && (count > 1 || isOfBlender);
}

/** @param numbers x y z per point */
function weighedBy(percents: FbxNumbers, numbers: FbxNumbers): FbxNumbers {
  return Float64Array.from(numbers, (value, i) => (value * percents[Math.floor(i / 3)]) / 100);
}

/**
 * The weight of one of a channel's shapes at a percentage: the shapes before and after it share it, the first with
 * the mesh itself; beyond the last it continues.
 */
export function shapeWeight(shapes: readonly FbxShape[], index: number, percent: number): number {
  const stops = [0, ...shapes.map(({ full }) => full)].sort((a, b) => a - b);
  let span = stops.findIndex((stop) => stop > percent) - 1;
  // Before the first and behind the last; what is below 0 continues from the mesh to the shape next to it.
  if (span < -1) span = stops.length - 2;
  if (span < 0) span = 0;
  const [from, to] = [stops[span], stops[span + 1]];
  const part = to === from ? 0 : (percent - from) / (to - from);
  const own = shapes[index].full;
  if (own === to) return part;
  return own === from ? 1 - part : 0;
}
