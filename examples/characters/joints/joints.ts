/** Every type of joint side by side, each moving its DOFs one after the other. */
import { compileSkeleton, worldMatrices } from '../../../src/evaluate/kinematics.ts';
import { restPose } from '../../../src/model/skeleton/dofs.ts';
import { dofsOf, takesLimits } from '../../../src/model/skeleton/joint-types.ts';
import { type Joint, type Limit, type Skeleton, UNLIMITED } from '../../../src/model/skeleton/skeleton.ts';
import type { Channel } from '../../../src/model/takes/take.ts';
import type { Sample } from '../example.ts';
import { held, type KeyRow, keyed } from '../motion/keys.ts';
import { painted } from '../paint/atlas.ts';
import { boxAbout } from '../shape/skeletons.ts';
import { buildJointsMesh, paintJoints } from './body.ts';
import { type Exhibit, PLACED, type Sway } from './exhibits.ts';

/** Duration of the whole cycle. */
const SECONDS = 6;
/** The root, in front of the lowest step: its name labels the whole example. */
const FRONT = [0, 0, 0.85] as const;

export function jointsSample(): Sample {
  const skeleton = buildJoints();
  const world = new Float64Array(16 * skeleton.joints.length);
  worldMatrices(compileSkeleton(skeleton), Float64Array.from(restPose(skeleton, 0)), world);
  return {
    id: 'joints',
    label: 'Joint types',
    description: 'Every joint type side by side, each moving its degrees of freedom in turn.',
    skeleton,
    skin: buildJointsMesh(world).skin('joints', world, { name: 'joints', texture: 'joints.png' }),
    morphs: [],
    take: {
      name: 'joints_each',
      range: [0, SECONDS],
      channels: [held(0), held(0), held(0), ...PLACED.flatMap(({ exhibit }) => channelsOf(exhibit))],
    },
    rig: { name: 'joints', skeleton: 'joints.skel', skin: 'joints.skin', morphs: [], animation: 'joints_each.anim' },
    textures: [painted('joints.png', paintJoints)],
    shows: { names: true },
  };
}

function buildJoints(): Skeleton {
  const root: Joint = {
    name: 'joint_types',
    parent: -1,
    offset: FRONT,
    box: boxAbout([0, 0.02, 0], [0.5, 0.02, 0.06]),
    motion: { kind: 'fixed' },
    limits: [],
    pose: [],
  };
  const joints = PLACED.map(({ exhibit, plinth }, i): Joint => {
    const { name, motion, at, piece, reach, length, couples, isChild } = exhibit;
    const dofs = dofsOf(motion);
    const limit = (rest: number): Limit => (reach === undefined ? UNLIMITED : { min: rest - reach, max: rest + reach });
    const tidy = (x: number) => Number(x.toFixed(4));
    const radius = piece.kind === 'block' ? 0 : piece.radius;
    return {
      name,
      // The root is 0: the exhibit before this one has index i.
      parent: isChild ? i : 0,
      offset: isChild ? at : [tidy(plinth[0] + at[0]), tidy(plinth[1] + at[1]), tidy(plinth[2] + at[2] - FRONT[2])],
      box:
        piece.kind === 'block'
          ? boxAbout(piece.centre, piece.half)
          : boxAbout(piece.kind === 'ball' ? piece.centre : [0, 0, 0], [
              radius,
              radius,
              piece.kind === 'ball' ? radius : 0.06,
            ]),
      motion,
      limits: dofs.map(({ rest }) => {
        const { min, max } = limit(rest);
        return takesLimits(motion) ? { min: tidy(min), max: tidy(max) } : UNLIMITED;
      }),
      pose: dofs.map(({ rest }) => rest),
      ...(length !== undefined && { length }),
      ...(couples && { couples: couples.map((couple) => ({ ...couple, joint: i })) }),
    };
  });
  return { name: 'joints', joints: [root, ...joints] };
}

/** Each DOF in its own part of the time, eased: to one side, to the other, and back. */
function channelsOf({ motion, sways }: Exhibit): Channel[] {
  const dofs = dofsOf(motion);
  return dofs.map(({ rest }, d) => {
    const sway = sways[d];
    if (sway === 0) return held(rest);
    const values = valuesOf(sway, rest, d / dofs.length, 1 / dofs.length);
    const rows = values.map(([part, value]): KeyRow => [time(part), Number(value.toFixed(4)), 'flat', 'flat']);
    if (rows[0][0] > 0) rows.unshift([0, rest, 'flat', 'flat']);
    if (rows[rows.length - 1][0] < SECONDS) rows.push([SECONDS, rest, 'flat', 'flat']);
    return keyed('cycle', rows);
  });
}

function valuesOf(sway: Sway, rest: number, from: number, length: number): readonly (readonly [number, number])[] {
  if (typeof sway !== 'number') return sway;
  const at = (part: number, value: number) => [from + part * length, value] as const;
  return [at(0.02, rest), at(0.27, rest + sway), at(0.73, rest - sway), at(0.98, rest)];
}

const time = (part: number): number => Number((part * SECONDS).toFixed(3));
