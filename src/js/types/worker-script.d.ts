/** The script of a worker that serves connections of `morse-smooth/worker`: importing it is all there is to do. */
export {};
