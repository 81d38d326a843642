// Its text.
