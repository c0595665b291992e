import { describe, expect, it } from 'vitest';
import { axisOfDof, dofAxis } from '../../../src/model/skeleton/dof-axis.ts';
import type { Motion } from '../../../src/model/skeleton/skeleton.ts';

const hinge = (...axis: readonly [number, number, number]): Motion => ({ kind: 'hinge', axis });

describe('the axis that a DOF is coloured by', () => {
  it('the axis that a DOF is coloured by is that of its name, whatever it does there', () => {
    for (const kind of 'rtsq') for (const axis of 'xyz') expect(dofAxis(undefined, kind + axis)).toBe(axis);
  });

  it('the axis that a DOF is coloured by is another one for each shear', () => {
    expect(['hxy', 'hxz', 'hyz'].map((name) => dofAxis({ kind: 'shear' }, name))).toEqual(['z', 'y', 'x']);
  });

  it('the axis that a DOF is coloured by is the main one that the joint turns about, either way', () => {
    expect(dofAxis(hinge(0, 1, 0), 'r')).toBe('y');
    expect(dofAxis(hinge(0, 0, -2), 'r')).toBe('z');
    expect(dofAxis({ kind: 'prismatic', axis: [3, 1e-9, 0] }, 't')).toBe('x');
  });

  it('the axis that a DOF is coloured by does not exist if the joint is oblique, or has no axis', () => {
    expect(dofAxis(hinge(1, 1, 0.5), 'r')).toBeUndefined();
    expect(dofAxis({ kind: 'scale', mode: 'uniform', axis: [0, 1, 0] }, 's')).toBeUndefined();
    expect(dofAxis({ kind: 'scale', mode: 'volume', axis: [0, 1, 0] }, 's')).toBe('y');
    expect(dofAxis({ kind: 'quaternion' }, 'qw')).toBeUndefined();
  });

  it('the axis that a DOF is coloured by is none for weights, which may be called anything', () => {
    expect(axisOfDof(undefined, { joint: -1, name: 'tx', unit: 'weight' })).toBeUndefined();
    expect(axisOfDof(undefined, { joint: 0, name: 'tx', unit: 'length' })).toBe('x');
  });
});
