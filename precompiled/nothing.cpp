// A target that only precompiles headers needs one source file.
