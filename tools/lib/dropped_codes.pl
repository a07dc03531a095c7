# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: perl -0n dropped_codes.pl FILE...
#
# Prints where C++ sources drop the code that a call of a library returns: where the call is a statement of its
# own. A code that nobody can act on is cast to void.

my $library = qr/(?:MPI_|CVode|N_V|SUN(?:Lin|Mat)|gsl_|klu_|ut_|cv_|(?:Petsc|Mat|Vec|KSP|PC|IS)(?=[A-Z]))\w+/;
my $system = qr/(?:std)?::(?:fclose|fwrite|fsync|ftruncate|rename|write)/;
my $cannot_fail = qr/(?:CVodeFree|N_VDestroy\w*|SUNMatDestroy|gsl_\w+_free|gsl_qrng_init|gsl_set_error_handler_off|
                        klu_defaults|klu_free_\w+|ut_free\w*|cv_free)\b/x;
my $checks_itself = qr/(?:PetscCall|PetscSession)\b/;

s{//[^\n]*}{}g;
while (/(?:[;{})]|\belse|\bdo)\s*\K(?!$cannot_fail|$checks_itself)($library|$system)\s*
        (\((?:[^()]++|(?2))*\))\s*(?=;)/gx) {
  my ($call, $line) = ($1, 1 + (substr($_, 0, $-[0]) =~ tr/\n//));
  print "$ARGV:$line: what $call returns is dropped\n";
}
