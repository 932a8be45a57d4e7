"""Curves through samples of finite resolution, and what the samples leave open."""
