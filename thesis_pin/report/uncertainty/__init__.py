"""What samples of finite resolution leave open of a report's numbers and of its verdict."""
