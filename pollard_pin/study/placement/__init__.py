"""Where a path should stand: placements judged, the best refined, and what is told of them."""
