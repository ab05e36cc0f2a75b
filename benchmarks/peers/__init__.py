"""Other libraries that compute the same, built the way their users build them."""
