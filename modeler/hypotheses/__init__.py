"""What every effect that may be missing is: columns with shapes, on the rows of the logs."""
