/** The name of an operation: docs/operations.md of liecheck. */
export type OperationName = string;
/** The numbers of one input, one after the other: a Float64Array, or a Float32Array in the scalar "float". */
export type Numbers = Float64Array | Float32Array;
/** The numbers of a result, one after the other; a matrix may be a list of rows. */
export type Result = number | ArrayLike<number> | Iterable<number> | number[][] | void;
/** A function, which refuses an input by throwing a RangeError; any other error is a crash. */
export type Call = (x: any) => Result;

/** A joint of a model: "Trees and robots" in docs/adapters.md. */
export interface Joint {
  kind: "revolute" | "prismatic" | "continuous" | "helical" | "spherical" | "planar" | "translation" | "free-flyer"
    | "mimic";
  parent: number;
  Q: number[];
  p: number[];
  axis?: number[];
  pitch?: number;
  armature?: number;
  mimic?: number;
  multiplier?: number;
  offset?: number;
}
export interface Body {
  joint: number;
  Q: number[];
  p: number[];
  mass: number;
  c: number[];
  I_C: number[];
}
/** What the class Model of an adapter is made of: joints and bodies, or a URDF. */
export interface Model {
  gravity: number[];
  nq: number;
  nv: number;
  joints?: Joint[];
  bodies?: Body[];
  urdf?: string;
  root?: "fixed" | "free-flyer";
  order?: string[];
}

export interface Settings {
  /** Letters, digits, _ and -; the name of the file if it is not given. */
  name?: string;
  /** The version of the library. */
  version?: string;
  /** In which it is tested; ["double"] if it is not given. */
  scalars?: ("double" | "float")[];
  /** Conventions other than liecheck's, such as {quaternion: "wxyz"}. */
  conventions?: {[of: string]: string};
  /** A class with operations on trees and robots; its constructor refuses a model by throwing any error. */
  Model?: new (model: Model) => object;
  /** Which models the class takes. */
  trees?: {models?: ("joints" | "urdf" | "mimics")[]; joints?: string[]; references?: ("world" | "local" | "aligned")[]};
  /** For the times of `liecheck cost`: a function that makes of an input a call in the library's own types. */
  own?: {[operation in OperationName]?: (x: any) => () => unknown};
}
/**
 * What an adapter exports: functions named as operations, each alone or with the program that a failure prints, in which
 * {phi} and so on stand for the numbers.
 */
export type Adapter = Settings & {[operation in OperationName]?: Call | [Call, string]};

/** Refuses the input of an operation: throws a RangeError. */
export function refuse(reason: string): never;
/** Answers calls of liecheck on the standard input, with the functions of an adapter. `npx liecheck` does so itself. */
export function serve(adapter: Adapter): void;
