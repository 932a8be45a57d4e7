"""What samples of finite resolution leave open of a path's numbers."""
