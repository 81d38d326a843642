// Its hand.
