// Its engine.
