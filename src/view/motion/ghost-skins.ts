/**
 * Ghosts as skins: the skin of the selected character in the poses before and after the current time, like glass, cool
 * before and warm after. Each ghost has a block of the palette and nothing else of its own: vertices are those of the
 * shown skin, and ghosts of one colour are instances of one call.
 */
import { Box3, Sphere } from 'three';
import { compileSkeleton, worldMatrices } from '../../evaluate/kinematics.ts';
import { type PoseSource, poseFrom, poseSource } from '../../evaluate/pose.ts';
import { compileSkin, skinMatrices } from '../../evaluate/skin/deform.ts';
import { NO_TRAVEL, placementMatrix } from '../../evaluate/space/placements.ts';
import { carrierOf, groundTravel } from '../../evaluate/travel.ts';
import type { Character } from '../../model/document.ts';
import type { Display } from '../../model/session.ts';
import { vertexCount } from '../../model/skin.ts';
import type { DrawnSkins, SkinDrawing } from '../skin/drawn-skins.ts';
import { PaletteSkeleton } from '../skin/palette-skeleton.ts';
import type { SharedSkin } from '../skin/shared-skins.ts';
import { MarrowSkinnedMesh } from '../skin/skinned-mesh.ts';
import type { StageTheme } from '../theme.ts';
import { GhostTimes } from './ghost-times.ts';
import { nearness } from './ghosts.ts';

/** Opacities between that of the nearest ghost and that of the furthest, which is `FAR`: a material each. */
const FADES = 4;
const FAR = 0.4;
/** While it plays, more vertices than these aren't drawn again as ghosts. */
const MAX_WHILE_PLAYING = 500_000;

/** One ghost: the skin in a pose, at each placement of the character. */
interface Ghost {
  readonly skeleton: PaletteSkeleton;
  readonly meshes: readonly MarrowSkinnedMesh[];
  /** As it is drawn; undefined while it isn't. */
  drawing: SkinDrawing | undefined;
}

export class GhostSkins {
  isPlaying = false;
  private readonly times = new GhostTimes();
  private readonly ghosts: Ghost[] = [];
  private readonly drawings = new Map<string, readonly SkinDrawing[]>();
  private before = '';
  private after = '';
  private source: PoseSource | undefined;
  private shared: SharedSkin | undefined;
  private dofs = new Float64Array(0);
  private world = new Float64Array(0);
  private readonly placement = new Float64Array(16);
  private readonly travel = new Float64Array(3);

  constructor(private readonly drawn: DrawnSkins) {}

  setTheme({ ghostBefore, ghostAfter }: StageTheme): void {
    this.before = ghostBefore;
    this.after = ghostAfter;
  }

  /**
   * Call every frame in which something moved; allocates nothing unless there are more ghosts than before.
   *
   * @param character whose ghosts are shown; undefined for none
   * @param shared its shown skin
   */
  fill(
    character: Character | undefined,
    shared: SharedSkin | undefined,
    display: Display,
    timeSeconds: number,
    range: readonly [number, number],
    framesPerSecond: number,
  ): void {
    const { times, ghosts } = this;
    times.count = 0;
    if (character && shared) {
      times.fill(character, display, timeSeconds, range, framesPerSecond);
      const vertices = times.count * character.placements.length * vertexCount(shared.skin);
      if (this.isPlaying && vertices > MAX_WHILE_PLAYING) times.count = 0;
    }
    const { count } = times;
    if (character && shared && count > 0) this.pose(character, shared, display);
    for (let g = count; g < ghosts.length; g++) this.draw(ghosts[g], undefined);
    if (!shared) this.clear();
  }

  dispose(): void {
    this.clear();
  }

  private pose(character: Character, shared: SharedSkin, display: Display): void {
    this.follow(character, shared);
    const { times, ghosts, source, dofs, world, placement, travel, drawn } = this;
    if (!character.skeleton || !source) return;
    const compiled = compileSkeleton(character.skeleton);
    const skin = compileSkin(shared.skin);
    const carrier = carrierOf(character);
    for (let g = 0; g < times.count; g++) {
      if (ghosts.length === g) ghosts.push(this.made(character, shared));
      const ghost = ghosts[g];
      const { matrices, weights } = ghost.skeleton;
      poseFrom(source, times.times[g], dofs);
      worldMatrices(compiled, dofs, world);
      skinMatrices(skin, world, matrices);
      for (let m = 0; m < weights.length; m++) weights[m] = dofs[dofs.length - weights.length + m];
      ghost.skeleton.upload();
      if (display.inPlace) groundTravel(compiled, character.space, carrier, dofs, world, travel);
      for (let p = 0; p < ghost.meshes.length; p++) {
        const { matrixWorld, sphere } = ghost.meshes[p];
        placementMatrix(character.placements[p], character.space, display.inPlace ? travel : NO_TRAVEL, placement);
        matrixWorld.fromArray(placement);
        sphere.center.set(world[12], world[13], world[14]);
      }
      const step = times.steps[g];
      this.draw(ghost, this.drawingOf(shared, step < 0 ? this.before : this.after, nearness(step, display)));
    }
    drawn.movePlacements();
  }

  /** Ghosts of another skin, or of another number of placements, are made anew. */
  private follow(character: Character, shared: SharedSkin): void {
    const [first] = this.ghosts;
    const morphs = character.morphs.length;
    const fits = first?.meshes.length === character.placements.length && first.skeleton.weights.length === morphs;
    if (this.shared !== shared || !fits) this.clear();
    this.shared = shared;
    if (this.source?.character === character) return;
    const source = poseSource(character);
    this.source = source;
    // Joints beyond this length have no matrix.
    const length = 16 * (source.skeleton?.jointCount ?? 0);
    if (this.world.length !== length) this.world = new Float64Array(length);
    if (this.dofs.length !== source.count) this.dofs = new Float64Array(source.count);
  }

  private made({ placements, morphs }: Character, shared: SharedSkin): Ghost {
    const { matrixCount, inverseBindings } = compileSkin(shared.skin);
    const skeleton = new PaletteSkeleton(this.drawn.palette, [], matrixCount, inverseBindings, morphs.length);
    const material = shared.materials.xray();
    // Never culled: where a ghost ends isn't worth finding out.
    const meshes = placements.map(
      () => new MarrowSkinnedMesh(shared, skeleton, material, new Sphere(undefined, Infinity), new Box3()),
    );
    return { skeleton, meshes, drawing: undefined };
  }

  private draw(ghost: Ghost, drawing: SkinDrawing | undefined): void {
    if (ghost.drawing === drawing) return;
    ghost.drawing = drawing;
    for (const mesh of ghost.meshes) this.drawn.draw(mesh, drawing);
  }

  private drawingOf(shared: SharedSkin, tint: string, near: number): SkinDrawing {
    let known = this.drawings.get(tint);
    if (!known) {
      known = Array.from({ length: FADES }, (_, i) => {
        return { material: shared.materials.xray(tint, FAR + ((1 - FAR) * i) / (FADES - 1)) };
      });
      this.drawings.set(tint, known);
    }
    return known[Math.round(near * (FADES - 1))];
  }

  private clear(): void {
    for (const ghost of this.ghosts) {
      this.draw(ghost, undefined);
      ghost.skeleton.dispose();
    }
    this.ghosts.length = 0;
    this.drawings.clear();
    this.shared = undefined;
  }
}
