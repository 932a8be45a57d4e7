"""What samples of finite resolution leave open of a gait's numbers."""
