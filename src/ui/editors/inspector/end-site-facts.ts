/** Positions of a joint's End Sites among its details: in the joint's space as in the file, and as posed. */
import { endSitePositions } from '../../../evaluate/end-sites.ts';
import type { Skeleton } from '../../../model/skeleton/skeleton.ts';
import type { FactList } from './fact-list.ts';

/**
 * Adds the tables, if a joint has End Sites. Returns a function that fills in the posed positions from all joints'
 * matrices and DOFs.
 */
export function endSiteTables(
  skeleton: Skeleton,
  index: number,
  list: FactList,
): (world: Float64Array, dofs: Float64Array) => void {
  const { endSites = [] } = skeleton.joints[index];
  if (endSites.length === 0) return () => {};
  const several = endSites.length > 1;
  const shape = {
    rows: endSites.length,
    columns: 3,
    columnLabels: ['x', 'y', 'z'],
    ...(several && { rowLabels: endSites.map((_, e) => `${e + 1}`) }),
  };
  const own = list.grid({ ...shape, label: several ? 'End Sites at' : 'End Site at' }).grid;
  const posed = list.grid({ ...shape, label: several ? 'End Sites in world' : 'End Site in world' }).grid;
  endSites.forEach((end, e) => {
    own.setRow(e, end);
  });
  return (world, dofs) => {
    const all = endSitePositions(skeleton, world, dofs).filter(({ joint }) => joint === index);
    all.forEach(({ position }, e) => {
      posed.setRow(e, position);
    });
  };
}
