// What there is of the API, for both ends of a connection: neither has a wrapper for each method.

/** The name of the message that asks for a connection, among whatever else is posted to a worker. */
export const GREETING = 'morse-smooth:connect';

/** A call with so many arguments before its options, of which it has none of its own. */
const plain = (before) => ({ before, hasOptions: false, isWatched: false });
/** A call with options. */
const brief = (before) => ({ before, hasOptions: true, isWatched: false });
/** A call with options among which is `onProgress`. */
const long = (before) => ({ before, hasOptions: true, isWatched: true });

/** A call that makes an object of this class: it is the result, or stands in the result under the name `at`. */
const making = (kind, call, at = null) => ({ ...call, makes: { kind, at } });
/** The constructor of a class as a function. */
const constructing = (kind, call) => ({ ...making(kind, call), isConstructor: true });

/** A property that takes time, as a function. */
const property = () => ({ ...plain(0), isProperty: true });

/**
 * The classes: the module that they are of; `facts`, properties that are known when an object is made and after each call that
 * `changes` it; the methods.
 */
export const classes = {
  TriMesh: {
    module: 'core',
    facts: ['vertexCount', 'edgeCount', 'triangleCount', 'area', 'warnings'],
    methods: {
      topology: property(),
      positions: plain(0),
      triangles: plain(0),
      vertexMap: plain(0),
      withoutMissing: making('TriMesh', plain(1), 'mesh'),
      criticalPoints: long(1),
      deltaHierarchy: long(1),
      levelSets: long(2),
      bands: long(2),
      persistence: long(1),
      persistenceCurve: long(1),
      simplify: long(1),
      morseComplex: long(1),
      morseHierarchy: long(1),
      basins: long(1),
      constrainedVertices: long(2),
      smoothness: long(1),
      laplacian: brief(0),
      mass: brief(0),
    },
  },
  Smoother: {
    module: 'core',
    facts: [],
    methods: {
      tikhonov: long(1),
      interpolate: long(1),
      leastSquares: long(1),
      lowPass: long(1),
      bilateral: long(1),
      prescribe: long(1),
      family: making('SmoothingFamily', long(1)),
      sweep: long(1),
    },
  },
  SmoothingFamily: {
    module: 'core',
    facts: ['epsilonRange', 'dimension', 'factorizations', 'shifts', 'errorEstimate', 'complete'],
    // It takes seconds to make, and it is not the same after `grow`: there is one of each.
    isSingle: true,
    methods: {
      errorAt: plain(1),
      grow: { ...long(0), changes: true },
      values: plain(1),
      at: long(1),
      sweep: long(0),
      choose: long(1),
      lives: long(0),
    },
  },
  Scene: {
    module: 'snapshot',
    facts: [],
    methods: {
      snapshot: brief(1),
      sheet: brief(2),
      surface: plain(0),
      drawList: brief(1),
    },
  },
};

/** The functions of each module, constructors included. */
const functionsOf = {
  core: {
    createMesh: constructing('TriMesh', brief(2)),
    createSmoother: constructing('Smoother', long(1)),
    smooth: long(2),
  },
  files: {
    formats: plain(0),
    readMesh: brief(1),
    readField: brief(1),
    readTable: brief(1),
    writeMesh: brief(1),
  },
  snapshot: {
    createScene: constructing('Scene', plain(2)),
    snapshot: brief(3),
    sheet: brief(4),
  },
};

/** All functions by their names, each with its module. */
export const functions = Object.fromEntries(
  Object.entries(functionsOf).flatMap(([module, calls]) =>
    Object.entries(calls).map(([name, call]) => [name, { ...call, module }]),
  ),
);

/** What there is of a method, or of a function where there is no class. */
export const callOf = (kind, name) =>
  kind === null ? functions[name] : { ...classes[kind].methods[name], module: classes[kind].module };
