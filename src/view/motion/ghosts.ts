/**
 * Ghosts (onion skin): poses of the selected character before and after the current time, as translucent bones, cool
 * before and warm after, fainter the further away in time. As skins: `ghost-skins.ts`.
 *
 *     now − 2·step   now − step   now   now + step   now + 2·step          see `ghost-times.ts`
 *
 * Two draw calls for all ghosts. They are posed every frame: six ghosts of 70 joints are 420 matrices, a fraction of a
 * millisecond, so nothing is cached that could go stale while scrubbing.
 */
import {
  Color,
  DynamicDrawUsage,
  Group,
  InstancedBufferAttribute,
  InstancedMesh,
  type Material,
  ShaderMaterial,
} from 'three';
import { compileSkeleton, worldMatrices } from '../../evaluate/kinematics.ts';
import { dofCountOf, type PoseSource, poseFrom, poseSource } from '../../evaluate/pose.ts';
import { NO_TRAVEL, placementMatrix } from '../../evaluate/space/placements.ts';
import { carrierOf, groundTravel } from '../../evaluate/travel.ts';
import type { Character } from '../../model/document.ts';
import type { Display } from '../../model/session.ts';
import { rawColor } from '../scene/thick-lines.ts';
import { ballGeometry, boneGeometry, type Level, levelFor } from '../skeleton/bone-levels.ts';
import { nodesFor, posedNodes, sizesFor } from '../skeleton/drawn-skeletons.ts';
import { fillBones, placementScale, placePoints } from '../skeleton/node-matrices.ts';
import type { StageTheme } from '../theme.ts';
import { GhostTimes } from './ghost-times.ts';

/** Opacity of the nearest and the furthest ghost. */
const NEAR_OPACITY = 0.5;
const FAR_OPACITY = 0.16;
/** Those of a few joints are pale, and have no more triangles than those of some. */
const GHOST_LEVELS: readonly Level[] = [1, 1, 2];

export class Ghosts {
  readonly object = new Group();
  /** By level. */
  private readonly ballLevels = GHOST_LEVELS.map(ballGeometry);
  private readonly boneLevels = GHOST_LEVELS.map(boneGeometry);
  private readonly balls: InstancedMesh;
  private readonly bones: InstancedMesh;
  /** r g b a per instance, shared by both meshes. */
  private tint = new InstancedBufferAttribute(new Float32Array(4), 4);
  private readonly ghostTimes = new GhostTimes();
  private source: PoseSource | undefined;
  private readonly before = new Color();
  private readonly after = new Color();
  private dofs = new Float64Array(0);
  private world = new Float64Array(0);
  private placed = new Float64Array(0);
  private readonly placement = new Float64Array(16);
  private readonly travel = new Float64Array(3);

  constructor() {
    const material = ghostMaterial();
    this.balls = new InstancedMesh(this.ballLevels[0], material, 1);
    this.bones = new InstancedMesh(this.boneLevels[0], material, 1);
    for (const mesh of [this.bones, this.balls]) {
      mesh.frustumCulled = false;
      mesh.matrixAutoUpdate = false;
      // Over grid and motion path, under the markers.
      mesh.renderOrder = 6;
      this.object.add(mesh);
    }
    this.object.visible = false;
  }

  setTheme(theme: StageTheme): void {
    this.before.copy(rawColor(theme.ghostBefore));
    this.after.copy(rawColor(theme.ghostAfter));
  }

  /** Call every frame in which something moved. @param character whose ghosts are shown; undefined for none */
  fill(
    character: Character | undefined,
    display: Display,
    timeSeconds: number,
    range: readonly [number, number],
    framesPerSecond: number,
  ): void {
    const { object, balls, bones, placement, travel } = this;
    object.visible = false;
    if (!character?.skeleton) return;
    const { ghostTimes } = this;
    ghostTimes.fill(character, display, timeSeconds, range, framesPerSecond);
    if (ghostTimes.count === 0) return;
    const { skeleton, placements } = character;
    const compiled = compileSkeleton(skeleton);
    const nodes = nodesFor(skeleton);
    const sizes = sizesFor(skeleton);
    this.makeRoom(nodes.count * placements.length * ghostTimes.count, nodes.count, dofCountOf(character));
    const { dofs, world, placed, tint } = this;
    const carrier = carrierOf(character);
    let first = 0;
    if (this.source?.character !== character) this.source = poseSource(character);
    for (let g = 0; g < ghostTimes.count; g++) {
      // Unkeyed changes apply at the current time only, so ghosts ignore them.
      poseFrom(this.source, ghostTimes.times[g], dofs);
      worldMatrices(compiled, dofs, world);
      if (display.inPlace) groundTravel(compiled, character.space, carrier, dofs, world, travel);
      const step = ghostTimes.steps[g];
      const color = step < 0 ? this.before : this.after;
      const opacity = FAR_OPACITY + (NEAR_OPACITY - FAR_OPACITY) * nearness(step, display);
      for (const place of placements) {
        placementMatrix(place, character.space, display.inPlace ? travel : NO_TRAVEL, placement);
        placePoints(posedNodes(nodes, skeleton, dofs), placement, 0, world, placed);
        const scale = placementScale(placement, 0);
        fillBones(nodes, compiled.parent, sizes, scale, placed, matricesOf(balls), matricesOf(bones), first);
        for (let n = first; n < first + nodes.count; n++) tint.setXYZW(n, color.r, color.g, color.b, opacity);
        first += nodes.count;
      }
    }
    const level = levelFor(first);
    balls.geometry = this.ballLevels[level];
    bones.geometry = this.boneLevels[level];
    balls.count = bones.count = first;
    balls.instanceMatrix.needsUpdate = bones.instanceMatrix.needsUpdate = tint.needsUpdate = true;
    object.visible = true;
  }

  dispose(): void {
    for (const geometry of [...this.ballLevels, ...this.boneLevels]) geometry.dispose();
    for (const mesh of [this.balls, this.bones]) {
      // One material, created above.
      (mesh.material as Material).dispose();
      mesh.dispose();
    }
  }

  private makeRoom(instances: number, nodes: number, dofs: number): void {
    if (this.dofs.length < dofs) this.dofs = new Float64Array(dofs);
    if (this.world.length < 16 * nodes) {
      this.world = new Float64Array(16 * nodes);
      this.placed = new Float64Array(16 * nodes);
    }
    if (this.tint.count >= instances && this.balls.geometry.hasAttribute('tint')) return;
    this.tint = new InstancedBufferAttribute(new Float32Array(4 * instances), 4).setUsage(DynamicDrawUsage);
    for (const mesh of [this.balls, this.bones]) {
      const matrices = new InstancedBufferAttribute(new Float32Array(16 * instances), 16);
      // Frees the old buffers.
      mesh.dispose();
      mesh.instanceMatrix = matrices.setUsage(DynamicDrawUsage);
    }
    for (const geometry of [...this.ballLevels, ...this.boneLevels]) geometry.setAttribute('tint', this.tint);
  }
}

/** 1 for the ghosts next to the current time, 0 for the furthest. */
export function nearness(step: number, { ghostsBefore, ghostsAfter }: Display): number {
  const furthest = step < 0 ? ghostsBefore : ghostsAfter;
  return furthest > 1 ? 1 - (Math.abs(step) - 1) / (furthest - 1) : 1;
}

function matricesOf(mesh: InstancedMesh): Float32Array {
  // Created as a Float32Array; three.js types it as any array.
  return mesh.instanceMatrix.array as Float32Array;
}

/**
 * A soft light from the camera, so that ghosts have shape. Writes depth, so that overlapping balls and bones don't
 * blend twice.
 */
function ghostMaterial(): ShaderMaterial {
  return new ShaderMaterial({
    transparent: true,
    toneMapped: false,
    vertexShader: /* glsl */ `
      attribute vec4 tint;
      varying vec4 vTint;
      varying vec3 vNormal;
      void main() {
        vTint = tint;
        vec4 at = modelViewMatrix * (instanceMatrix * vec4(position, 1.0));
        // Equal radii on both axes across a bone keep its normals' directions without an inverse.
        vNormal = mat3(modelViewMatrix) * (mat3(instanceMatrix) * normal);
        gl_Position = projectionMatrix * at;
      }
    `,
    fragmentShader: /* glsl */ `
      varying vec4 vTint;
      varying vec3 vNormal;
      void main() {
        float facing = abs(normalize(vNormal).z);
        gl_FragColor = vec4(vTint.rgb * mix(0.72, 1.0, facing), vTint.a);
      }
    `,
  });
}
