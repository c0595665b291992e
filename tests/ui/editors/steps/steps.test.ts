import { describe, expect, it } from 'vitest';
import type { Vec3 } from '../../../../src/math/vec3.ts';
import { oneSurface } from '../../../../src/model/skin.ts';
import { stepsOfPose } from '../../../../src/teaching/steps/dof-steps.ts';
import { stepsOfJoint } from '../../../../src/teaching/steps/joint-steps.ts';
import { vertexStepper } from '../../../../src/teaching/steps/vertex-steps.ts';
import { meaningText } from '../../../../src/ui/editors/steps/formula-view.ts';
import { sourcesText } from '../../../../src/ui/editors/steps/joint-view.ts';
import { paintStage } from '../../../../src/ui/editors/steps/paint-stage.ts';
import { jointStages, type Stages, vertexStages } from '../../../../src/ui/editors/steps/stages.ts';
import { channel, character, skeleton, take } from '../../builders.ts';

const arm = skeleton(['shoulder', -1], ['elbow', 0]);
const own = character({ skeleton: arm, pose: [0, 0, 0, 0, 0, Math.PI / 2, 0, 0, Math.PI / 2] });

function stagesOf(joint: number): Stages {
  const steps = stepsOfJoint(stepsOfPose(own, 0), joint);
  if (!steps) throw new Error('No such joint.');
  return jointStages(steps);
}

describe('the slider of Steps', () => {
  it('the slider goes from the parent’s frame over each factor to the joint', () => {
    const stages = stagesOf(1);
    expect(stages.labels).toEqual(['W₀', 'times T(offset)', 'times Rz(rz)', 'times Ry(ry)', 'times Rx(rx)']);
    expect(stages.kind === 'frames' && stages.frames).toHaveLength(5);
    expect(stagesOf(0).labels.slice(0, 3)).toEqual(['origin', 'times T(tx, ty, tz)', 'times T(offset)']);
  });

  it('the slider goes from a vertex in the file over its morphs and each attachment to where it is drawn', () => {
    const skin = {
      name: 'x',
      positions: Float64Array.of(1, 0, 0),
      triangles: new Uint32Array(0),
      surfaces: oneSurface(new Uint32Array(0)),
      bindings: new Float64Array(0),
      attachments: { start: Uint32Array.of(0, 1), joints: Uint32Array.of(0), weights: Float64Array.of(1) },
    };
    const none = { indices: new Uint32Array(0), values: new Float64Array(0) };
    const smile = {
      name: 'smile',
      positions: { indices: Uint32Array.of(0), values: Float64Array.of(2, 0, 0) },
      normals: none,
    };
    const world = Float64Array.of(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 5, 0, 1);
    const stages = vertexStages(vertexStepper(skin, [smile], 0)(Float64Array.of(1), world));
    expect(stages).toEqual({
      kind: 'places',
      labels: ['v₀, in the file', 'v, with morphs', 'W₀ · B₀⁻¹ · v', 'v′, as drawn'],
      places: [
        [1, 0, 0],
        [2, 0, 0],
        [2, 5, 0],
        [2, 5, 0],
      ],
    });
    expect(vertexStages(vertexStepper(skin, [], 0)(new Float64Array(0), undefined)).labels).toEqual([
      'v₀, in the file',
    ]);
  });
});

describe('what Steps draws in the viewport', () => {
  /** Twice as large, and 10 to the right. */
  const placement = Float64Array.of(2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 10, 0, 0, 1);

  function painted(stages: Stages, index: number) {
    const lines: { from: Vec3; to: Vec3; color: string }[] = [];
    const marks: { at: Vec3; color: string }[] = [];
    const painter = {
      mark: (at: Vec3, { color }: { color: string }) => void marks.push({ at, color }),
      line: (from: Vec3, to: Vec3, color: string) => void lines.push({ from, to, color }),
    };
    paintStage(painter, stages, index, placement, () => 0.01);
    return { lines, marks };
  }

  it('draws the frame at its place in the scene, with axes of one length whatever the size of the character', () => {
    const { lines, marks } = painted(stagesOf(1), 4);
    expect(marks).toHaveLength(1);
    // The shoulder is 1 up, and turned by 90 degrees about z: the elbow is 1 to the left of it.
    close(marks[0].at, [10 - 2, 2, 0]);
    const x = lines.filter(({ color }) => color === 'axisX').at(-1);
    if (!x) throw new Error('No axis.');
    close(x.to, [8 - 0.64, 2, 0]);
  });

  it('draws the parent’s frame alone where nothing is applied', () => {
    expect(painted(stagesOf(1), 0).lines.map(({ color }) => color)).toEqual(['axisX', 'axisY', 'axisZ']);
  });

  it('draws the places of a vertex so far, and at the end what they are mixed to', () => {
    const places: Stages = {
      kind: 'places',
      labels: ['a', 'b', 'c'],
      places: [
        [0, 0, 0],
        [1, 0, 0],
        [0.5, 1, 0],
      ],
    };
    expect(painted(places, 1).marks.map(({ color }) => color)).toEqual(['label', 'selected']);
    expect(painted(places, 1).lines).toEqual([]);
    expect(painted(places, 2).lines.map(({ from, to }) => [from, to])).toEqual([
      [
        [10, 0, 0],
        [11, 2, 0],
      ],
      [
        [12, 0, 0],
        [11, 2, 0],
      ],
    ]);
  });
});

describe('the words of Steps', () => {
  it('tell where values come from, and what symbols stand for', () => {
    const moving = { ...own, takes: [take([0, 1], ...Array.from({ length: 7 }, () => channel(0)))] };
    const steps = stepsOfJoint(stepsOfPose(moving, 0), 1);
    expect(sourcesText(steps?.values ?? [], String)).toBe('rx from the take; ry rz from the pose; radians');
    expect(meaningText({ kind: 'joint', joint: 1 }, own)).toBe('Joint elbow');
    expect(meaningText({ kind: 'dof', dof: 7 }, own)).toBe('DOF ry of elbow');
    const link = { dof: 7, follows: 3, gain: 2, offset: -0.25, followed: 1 };
    const linked = { dof: 7, name: 'ry', unit: 'angle', source: 'link', given: 1.75, value: 1.75, link } as const;
    expect(sourcesText([linked], (dof) => `DOF ${dof}`)).toBe('ry = 2 · DOF 3 − 0.25; radians');
  });
});

function close(found: Vec3, meant: Vec3): void {
  found.forEach((part, k) => {
    expect(part).toBeCloseTo(meant[k], 12);
  });
}
