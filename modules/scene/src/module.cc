namespace asperity {}
