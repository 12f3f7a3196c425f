// SPDX-License-Identifier: GPL-3.0-or-later
//
// The types of kinetri.mjs, which describes the functions.

/** Pairs, or a flat array of twice as many numbers. */
export type Vectors = ArrayLike<readonly [number, number]> | ArrayLike<ArrayLike<number>> | ArrayLike<number>;

/** The ends of an edge, the smaller id first. */
export type Edge = [number, number];

export interface Options {
  /** Of each point: the second and the third derivative of its position, at time 0. */
  accelerations?: Vectors;
  jerks?: Vectors;
  /** [xmin, ymin, xmax, ymax]: its sides reflect the points. */
  box?: ArrayLike<number> | null;
  /** The radius of all discs; or of each point the radius at time 0, and its growth in a unit of time. */
  radius?: number;
  radii?: ArrayLike<number>;
  growths?: ArrayLike<number>;
  /** Of each point, for elastic collisions; 1 if left out. */
  masses?: ArrayLike<number>;
  /** What happens when two discs touch; 'none' if left out. */
  collisions?: 'none' | 'log' | 'swap' | 'elastic' | 'stop' | 'remove';
  /** Whether discs, not their centers, are reflected. */
  rim?: boolean;
  /** Whether the triangulation is the regular one of the discs, even if nothing touches them. */
  regular?: boolean;
  /** Without floating point in decisions: the same result, slowly. */
  exactOnly?: boolean;
}

export type Kind = 'flip' | 'hull_insert' | 'hull_remove' | 'rebuild' | 'hide' | 'reveal' | 'wall' | 'collision' |
  'insert' | 'erase' | 'trajectory';

export interface KineticEvent {
  number: number;
  kind: Kind;
  /** The number nearest to the exact time, which is between `lower` and `upper`. */
  time: number;
  lower: number;
  upper: number;
  removed: Edge | null;
  added: Edge | null;
  points: number[];
}

export interface NextEvent extends Omit<KineticEvent, 'number'> {
  /** Coefficients, from the constant one on, as decimal texts. */
  polynomial: string[];
}

export class KinetriError extends Error {}

export function load(source?: WebAssembly.Module | BufferSource): Promise<void>;

export class KineticDelaunay {
  constructor(positions: Vectors, velocities?: Vectors | null, options?: Options);
  static read(text: string, options?: Options): KineticDelaunay;
  close(): void;

  readonly time: number;
  readonly length: number;
  positions(): Float64Array;
  velocities(): Float64Array;
  accelerations(): Float64Array;
  radii(): Float64Array;
  masses(): Float64Array;
  edges(): Uint32Array;
  triangles(): Uint32Array;
  audit(): string[];
  statistics(): { events: number; filtered: number; exact: number };

  advanceTo(time: number, milliseconds?: number): boolean;
  step(): number;
  nextEvent(): NextEvent | null;
  watch(callback: (event: KineticEvent) => void): void;

  setVelocities(velocities: Vectors): void;
  setVelocities(ids: ArrayLike<number>, velocities: Vectors): void;
  setMotions(ids: ArrayLike<number>, positions: Vectors, velocities?: Vectors, accelerations?: Vectors): void;
  setMass(id: number, mass: number): void;
  insert(position: readonly [number, number], velocity?: readonly [number, number], radius?: number,
    acceleration?: readonly [number, number]): number;
  erase(id: number): void;

  logMotions(): void;
  takeMotions(): string;
  logEvents(): void;
  takeEvents(): string;
  record(capacity: number): void;
  takeRecording(): string;
}
