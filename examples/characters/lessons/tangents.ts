/**
 * An arm for explaining tangents and extrapolation: every joint moves in one channel, which has keys from 0 to 2
 * seconds and one kind of extrapolation, while the range runs from −2 to 6. Each joint has a colour of its own.
 *
 *     joint                   channel   tangents              before 0 and after 2 seconds
 *     turntable_linear        ry        linear                continues at the same speed
 *     shoulder_constant       rz        flat                  holds its value
 *     elbow_cycle             rz        smooth                starts again
 *     wrist_bounce            rz        numbers (slopes)      plays back and forth
 *     hand_cycle_offset       ry        flat, then linear     starts again from the last value
 */
import type { Vec3 } from '../../../src/math/vec3.ts';
import type { Channel } from '../../../src/model/takes/take.ts';
import type { Sample } from '../example.ts';
import { held, keyed } from '../motion/keys.ts';
import { Atlas, blend, colour } from '../paint/atlas.ts';
import { encodePng } from '../paint/png.ts';
import { around, loft, MeshBuilder, type Rect, type Section } from '../shape/mesh.ts';
import { bindingMatrices, boxAbout, buildSkeleton, posedFrames } from '../shape/skeletons.ts';
import { chainWeights } from '../shape/weights.ts';

const SKELETON = buildSkeleton('tangents', [
  { name: 'turntable_linear', offset: [0, 0, 0], box: boxAbout([0, 0.1, 0], [0.22, 0.1, 0.22]) },
  {
    name: 'shoulder_constant',
    parent: 'turntable_linear',
    offset: [0, 0.25, 0],
    box: boxAbout([0, 0.275, 0], [0.07, 0.275, 0.07]),
  },
  {
    name: 'elbow_cycle',
    parent: 'shoulder_constant',
    offset: [0, 0.55, 0],
    box: boxAbout([0, 0.225, 0], [0.06, 0.225, 0.06]),
  },
  {
    name: 'wrist_bounce',
    parent: 'elbow_cycle',
    offset: [0, 0.45, 0],
    box: boxAbout([0, 0.15, 0], [0.05, 0.15, 0.05]),
  },
  {
    name: 'hand_cycle_offset',
    parent: 'wrist_bounce',
    offset: [0, 0.3, 0],
    box: boxAbout([0, 0.17, 0], [0.14, 0.13, 0.03]),
  },
]);

/** By joint: which of rx ry rz is animated, and how. */
const MOVES: readonly { readonly axis: number; readonly channel: Channel }[] = [
  {
    axis: 1,
    channel: keyed('linear', [
      [0, 0, 'linear', 'linear'],
      [2, 0.8, 'linear', 'linear'],
    ]),
  },
  {
    axis: 2,
    channel: keyed('constant', [
      [0, 0.55, 'flat', 'flat'],
      [1, 0.1, 'flat', 'flat'],
      [2, 0.4, 'flat', 'flat'],
    ]),
  },
  {
    axis: 2,
    channel: keyed('cycle', [
      [0, -0.7, 'smooth', 'smooth'],
      [0.5, -1.3, 'smooth', 'smooth'],
      [1.25, -0.5, 'smooth', 'smooth'],
      [2, -0.7, 'smooth', 'smooth'],
    ]),
  },
  {
    axis: 2,
    channel: keyed('bounce', [
      [0, -0.6, 0, 0],
      [0.75, 0.35, 2, 2],
      [1.25, 0.1, -1.5, 0.5],
      [2, 0.7, 0, 0],
    ]),
  },
  {
    axis: 1,
    channel: keyed('cycle_offset', [
      [0, 0, 'flat', 'flat'],
      [1.2, 0, 'flat', 'linear'],
      [2, 0.5236, 'linear', 'flat'],
    ]),
  },
];

/** Height, half width, half depth. */
const PROFILE: readonly Vec3[] = [
  [0, 0.001, 0.001],
  [0, 0.3, 0.3],
  [0.08, 0.3, 0.3],
  [0.13, 0.16, 0.16],
  [0.24, 0.12, 0.12],
  [0.32, 0.105, 0.105],
  [0.68, 0.095, 0.095],
  [0.77, 0.112, 0.112],
  [0.84, 0.105, 0.105],
  [0.95, 0.085, 0.085],
  [1.18, 0.085, 0.085],
  [1.25, 0.1, 0.1],
  [1.33, 0.082, 0.082],
  [1.48, 0.07, 0.07],
  [1.56, 0.085, 0.066],
  [1.64, 0.16, 0.05],
  [1.74, 0.165, 0.042],
  [1.86, 0.06, 0.028],
  [1.9, 0.001, 0.001],
];
const BENDS = [0.25, 0.8, 1.25, 1.55];
const SOFT = 0.07;
const ATLAS_SIZE = 64;
const RECT: Rect = [4, 2, 56, 60];
const COLOURS = ['#4a5a78', '#e2614f', '#f4b840', '#2f938c', '#8a5aa8'].map(colour);
const EDGE = colour('#fdeed4');

const sections = PROFILE.map(
  ([y, wide, deep]): Section => ({ at: [0, y, 0], side: [wide, 0, 0], front: [0, 0, deep] }),
);

export function tangentsSample(): Sample {
  const mesh = new MeshBuilder(ATLAS_SIZE);
  const point = loft(sections);
  mesh.addPart({
    point,
    angles: around(8),
    rows: sections.map((_, i) => i / (sections.length - 1)),
    startPole: true,
    endPole: true,
    rect: RECT,
    weights: (p) =>
      chainWeights(
        p[1],
        0,
        BENDS.map((from, i) => ({ joint: i + 1, from, soft: SOFT })),
      ),
  });
  const atlas = new Atlas(ATLAS_SIZE, COLOURS[0]);
  atlas.paint(RECT, (u, v) => {
    const y = point(Math.PI * u, v)[1];
    if (BENDS.some((bend) => Math.abs(y - bend) < 0.014)) return EDGE;
    const at = COLOURS[BENDS.filter((bend) => y > bend).length];
    // The hand's front differs from its back, so that its rotation is visible.
    return y > BENDS[3] && u < 0.5 ? blend(at, EDGE, 0.55) : at;
  });
  return {
    id: 'tangents',
    label: 'Tangents',
    description: 'An arm with every kind of tangent, each joint showing one kind of extrapolation.',
    skeleton: SKELETON,
    skin: mesh.skin('tangents', bindingMatrices(posedFrames(SKELETON)), { name: 'arm', texture: 'tangents.png' }),
    morphs: [],
    take: {
      name: 'tangents',
      range: [-2, 6],
      channels: [
        held(0),
        held(0),
        held(0),
        ...MOVES.flatMap(({ axis, channel }) => [0, 1, 2].map((a) => (a === axis ? channel : held(0)))),
      ],
    },
    rig: {
      name: 'tangents',
      skeleton: 'tangents.skel',
      skin: 'tangents.skin',
      morphs: [],
      animation: 'tangents.anim',
    },
    textures: [{ name: 'tangents.png', bytes: encodePng(atlas.pixels, atlas.size) }],
  };
}
