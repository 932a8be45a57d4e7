"""Any robot moved one coordinate after another, its loops closed all the way."""
