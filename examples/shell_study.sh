slapstick show vibro-impact --set restitution=0.6 --out mine.toml   # a model is a text file: change what you like
slapstick check mine.toml | grep sound
slapstick simulate mine.toml --set omega=1.5 --periods 50 --events events.csv --plot motion.png --out summary.json
grep -c impact events.csv
for omega in 0.552 1.5 2.2 4.8 9; do
  echo "$omega $(slapstick classify mine.toml --set omega=$omega | grep '"class"')"
done
slapstick poincare mine.toml --set omega=9 --transient 3000 --points 2000 --plot section.png --out points.csv
slapstick diagram mine.toml --sweep omega=4:6:300 --direction both --plot diagram.png --out impacts.csv
head -n 1 impacts.csv
